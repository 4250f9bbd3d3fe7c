// VTK's renderer, off screen: drawn at twice the size and averaged, which smooths edges and keeps transparency exact.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/report/scene.hpp>

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellData.h>
#include <vtkColorSeries.h>
#include <vtkColorTransferFunction.h>
#include <vtkImageData.h>
#include <vtkLightKit.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cstdio>

#include <palpate/errors.hpp>

namespace palpate {
namespace {

constexpr int oversampling = 2;

/// Brewer's sequences (colorbrewer2.org, Apache 2) as VTK keeps them, without the palest.
std::vector<vtkColor3ub> colours_of(Tones tones) {
  vtkNew<vtkColorSeries> series;
  series->SetColorScheme(tones == Tones::stress ? vtkColorSeries::BREWER_SEQUENTIAL_YELLOW_ORANGE_BROWN_9
                                                : vtkColorSeries::BREWER_SEQUENTIAL_BLUE_GREEN_9);
  std::vector<vtkColor3ub> colours;
  for (int i = 1; i < series->GetNumberOfColors(); ++i) colours.push_back(series->GetColor(i));
  return colours;
}

vtkSmartPointer<vtkColorTransferFunction> field_map(Tones tones, double top) {
  const auto colours = colours_of(tones);
  auto map = vtkSmartPointer<vtkColorTransferFunction>::New();
  map->SetColorSpaceToRGB();
  for (std::size_t i = 0; i < colours.size(); ++i)
    map->AddRGBPoint(top * double(i) / (colours.size() - 1), colours[i][0] / 255.0, colours[i][1] / 255.0, colours[i][2] / 255.0);
  return map;
}

vtkSmartPointer<vtkActor> actor_of(vtkPolyData& shape, const Look& look) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(&shape);
  mapper->ScalarVisibilityOff();
  if (!look.field.empty()) {
    mapper->ScalarVisibilityOn();
    if (shape.GetPointData()->HasArray(look.field.c_str()))
      mapper->SetScalarModeToUsePointFieldData();
    else
      mapper->SetScalarModeToUseCellFieldData();
    mapper->SelectColorArray(look.field.c_str());
    mapper->SetLookupTable(field_map(look.tones, look.top));
    mapper->InterpolateScalarsBeforeMappingOn();
    mapper->UseLookupTableScalarRangeOn();
  }
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  vtkProperty& property = *actor->GetProperty();
  property.SetColor(look.colour[0], look.colour[1], look.colour[2]);
  property.SetLineWidth(look.line_width * oversampling);
  property.SetEdgeVisibility(look.edges);
  property.SetEdgeColor(0.10, 0.12, 0.16);
  property.SetAmbient(look.lit ? 0.22 : 1);
  property.SetDiffuse(look.lit ? 0.78 : 0);
  property.SetLighting(look.lit);
  return actor;
}

void aim_camera(vtkRenderer& renderer, const View& view) {
  vtkCamera& camera = *renderer.GetActiveCamera();
  const double away = 10 * (view.width_mm + view.height_mm);
  const Vec3 eye = view.centre - away * unit(view.toward);
  camera.ParallelProjectionOn();
  camera.SetFocalPoint(view.centre.data());
  camera.SetPosition(eye.data());
  camera.SetViewUp(view.up.data());
  camera.SetParallelScale(view.height_mm / 2);
  renderer.ResetCameraClippingRange();
}

/// White light, mostly from above; softer shadows than the kit's own.
vtkSmartPointer<vtkLightKit> even_lights() {
  auto kit = vtkSmartPointer<vtkLightKit>::New();
  constexpr double white = 0.5;
  kit->SetKeyLightWarmth(white);
  kit->SetFillLightWarmth(white);
  kit->SetHeadLightWarmth(white);
  kit->SetBackLightWarmth(white);
  kit->SetKeyLightIntensity(0.75);
  kit->SetKeyToHeadRatio(1.8);
  kit->SetKeyToFillRatio(2.5);
  return kit;
}

/// Means of oversampling × oversampling pixels. VTK leaves colours multiplied by their opacity; a PNG wants them plain.
vtkSmartPointer<vtkImageData> averaged(vtkUnsignedCharArray& fine, int width, int height) {
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(width, height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  const unsigned char* from = fine.GetPointer(0);
  auto* to = static_cast<unsigned char*>(image->GetScalarPointer());
  constexpr int n = oversampling;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x, to += 4) {
      int sum[4] = {0, 0, 0, 0};
      for (int sub = 0; sub < n * n; ++sub) {
        const std::size_t pixel = std::size_t(y * n + sub / n) * width * n + x * n + sub % n;
        for (int c = 0; c < 4; ++c) sum[c] += from[4 * pixel + c];
      }
      for (int c = 0; c < 3; ++c)
        to[c] = sum[3] == 0 ? 0 : static_cast<unsigned char>(std::min(255, (sum[c] * 255 + sum[3] / 2) / sum[3]));
      to[3] = static_cast<unsigned char>((sum[3] + n * n / 2) / (n * n));
    }
  return image;
}

std::string png_bytes(vtkImageData& image) {
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(&image);
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray* bytes = writer->GetResult();
  return {reinterpret_cast<const char*>(bytes->GetPointer(0)), std::size_t(bytes->GetNumberOfValues())};
}

bool is_empty(vtkUnsignedCharArray& pixels) {
  for (vtkIdType i = 3; i < pixels.GetNumberOfValues(); i += 4)
    if (pixels.GetValue(i) != 0) return false;
  return true;
}

}  // namespace

View fit_view(const std::vector<Vec3>& points, const Vec3& toward, const Vec3& up) {
  const Vec3 into = unit(toward);
  const Vec3 right = unit(cross(into, up));
  const Vec3 above = cross(right, into);
  const std::array<Vec3, 3> axes{right, above, into};
  std::array<double, 3> low, high;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  for (const Vec3& point : points)
    for (int a = 0; a < 3; ++a) {
      low[a] = std::min(low[a], dot(point, axes[a]));
      high[a] = std::max(high[a], dot(point, axes[a]));
    }
  constexpr double margin = 1.06;
  View view{into, above, {0, 0, 0}, margin * (high[0] - low[0]), margin * (high[1] - low[1])};
  for (int a = 0; a < 3; ++a) view.centre = view.centre + ((low[a] + high[a]) / 2) * axes[a];
  view.height_mm = std::max(view.height_mm, 0.45 * view.width_mm);
  view.width_mm = std::max(view.width_mm, 1.1 * view.height_mm);
  return view;
}

struct Scene::Shape {
  vtkSmartPointer<vtkPolyData> shape;
  Look look;
};

Scene::Scene() = default;
Scene::~Scene() = default;

void Scene::add(vtkPolyData* shape, const Look& look) { shapes_.push_back({shape, look}); }

Picture Scene::draw(const View& view, int width_pixels) const {
  Picture picture;
  picture.width = width_pixels;
  picture.height = std::max(1, static_cast<int>(std::lround(width_pixels * view.height_mm / view.width_mm)));
  picture.mm_per_pixel = view.width_mm / width_pixels;
  picture.right = unit(cross(view.toward, view.up));
  picture.up = unit(cross(picture.right, view.toward));
  vtkNew<vtkRenderer> renderer;
  for (const Shape& shape : shapes_) {
    const auto actor = actor_of(*shape.shape, shape.look);
    Vec3 lifted = (-1e-3 * shape.look.layer * view.width_mm) * unit(view.toward);  // unseen in parallel projection
    actor->SetPosition(lifted.data());
    renderer->AddActor(actor);
  }
  renderer->SetBackground(0, 0, 0);
  renderer->SetBackgroundAlpha(0);
  const auto lights = even_lights();
  lights->AddLightsToRenderer(renderer);
  aim_camera(*renderer, view);
  vtkNew<vtkRenderWindow> window;
  window->OffScreenRenderingOn();
  window->SetAlphaBitPlanes(1);
  window->SetMultiSamples(0);
  window->SetSize(picture.width * oversampling, picture.height * oversampling);
  window->AddRenderer(renderer);
  lights->Update();
  window->Render();
  vtkNew<vtkUnsignedCharArray> pixels;
  window->GetRGBACharPixelData(0, 0, picture.width * oversampling - 1, picture.height * oversampling - 1, 0, pixels);
  if (pixels->GetNumberOfValues() == 0 || is_empty(*pixels))
    throw Failure(ExitCode::unreadable, "nothing could be drawn: OpenGL gives an empty picture", "",
                  "apt install xvfb libgl1-mesa-dri");
  picture.png = png_bytes(*averaged(*pixels, picture.width, picture.height));
  return picture;
}

std::vector<std::string> tone_colours(Tones tones) {
  std::vector<std::string> colours;
  for (const vtkColor3ub& c : colours_of(tones)) {
    char text[8];
    std::snprintf(text, sizeof text, "#%02x%02x%02x", c[0], c[1], c[2]);
    colours.emplace_back(text);
  }
  return colours;
}

}  // namespace palpate
