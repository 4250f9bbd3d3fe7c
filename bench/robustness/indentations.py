# Sixty generated indentations: who reaches full depth, who stops and why.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Sixty indentations, three organs × seven tools × seven laws × nu from 0.3 to exactly 1/2 × friction 0, 0.3, 0.8, to 40 % of the organ's
thickness under the tool: who reaches full depth, who stops and why, and whether forces and energy balance. Numbers kept, not asserted.

    python3 bench/robustness/indentations.py BIN FOLDER [remesh] [NUMBER ...]

BIN: the folder of the executables (palpate-surface, palpate-mesh, palpate-solve); FOLDER: meshes, cases and table.csv; NUMBERs from 0 to 59: only
these; remesh: with [remesh] in the cases, up to 3 000 nodes. table.csv: number, organ, tool, law, nu, friction, exit code, seconds, iterations, cuts, worst force imbalance, worst penetration (of a face),
peak force (N), nodes, worst energy imbalance (of the largest work), message. A run whose forces are out of balance by more than 1e-3, or whose
energy is by more than 1 %, is a wrong answer: it is told so and not counted as reached. The work is a sum over eight steps: a case whose energy
alone is out of balance is solved again in sixteen, and is right if the energy is in balance there and the peak force the same to 1e-3. cases.jsonl: the same, one object a case, written as each ends. A case may take 240 s of processor time, after which it
is stopped and counts as not reached (exit code "time").
"""
import json
import pathlib
import resource
import subprocess
import sys

import organs

MU = 0.0067  # MPa
TOOLS = ["rod", "ball", "flat_punch", "rounded_punch", "box", "cylinder", "plane"]
LAWS = ["hooke", "neo_hookean", "mooney_rivlin", "yeoh", "fung_demiray", "ogden", "hgo"]
NUS = [0.3, 0.4, 0.45, 0.49, 0.5]
FRICTIONS = [0, 0.3, 0.8]
LIMIT_S = 240  # of processor time, a case
COLUMNS = ["number", "organ", "tool", "law", "nu", "friction", "exit", "seconds", "iterations", "cuts", "worst_force_imbalance", "worst_penetration",
           "peak_force_N", "nodes", "worst_energy_imbalance", "message"]
MOST_FORCE, MOST_ENERGY = 1e-3, 0.01  # imbalances, beyond which an answer is wrong


def combination(number):
    """Every pair of values comes together in some case (but two of a tool and a law)."""
    organ = list(organs.SHAPES)[number % 3]
    i = number // 3
    return organ, TOOLS[(i + 2 * (number % 3)) % 7], LAWS[(3 * i + i // 7 + number) % 7], NUS[(i + i // 3) % 5], FRICTIONS[(i + i // 3 + number) % 3]


def material(law, nu):
    keys = {"hooke": f"E = {2 * MU * (1 + nu)}\nnu = {nu}", "neo_hookean": f"mu = {MU}", "mooney_rivlin": f"C10 = {MU * 0.3}\nC01 = {MU * 0.2}",
            "yeoh": f"C10 = {MU / 2}\nC20 = {MU / 4}\nC30 = {MU / 20}", "fung_demiray": f"mu = {MU}\nb = 1.0",
            "ogden": "mu1 = 0.004\nalpha1 = 3.0\nmu2 = 0.002\nalpha2 = -4.0\nmu3 = 0.0007\nalpha3 = 8.0",
            "hgo": f"mu = {MU}\nk1 = 0.004\nk2 = 1.5\nangle_deg = 35.0\naxis_x = 1.0\naxis_y = 0.0\naxis_z = 0.0\nside_x = 0.0\nside_y = 1.0\nside_z = 0.0"}
    kappa = "" if law == "hooke" or nu == 0.5 else f"\nkappa = {2 * MU * (1 + nu) / (3 * (1 - 2 * nu))}"
    return f'[material]\nlaw = "{law}"\n{keys[law]}{kappa}\n'


def tool(kind, thickness):
    r = 0.2 * thickness
    size = {"rod": f"radius_mm = {r}", "ball": f"radius_mm = {1.5 * r}", "flat_punch": f"radius_mm = {r}\nedge_radius_mm = {0.3 * r}",
            "rounded_punch": f"radius_mm = {r}\ndome_radius_mm = {2 * r}\nedge_radius_mm = {0.3 * r}",
            "box": f"width_mm = {2 * r}\nlength_mm = {4 * r}\nheight_mm = {thickness}\nedge_radius_mm = {0.4 * r}",
            "cylinder": f"radius_mm = {r}\nlength_mm = {4 * r}\nedge_radius_mm = {0.4 * r}", "plane": ""}
    return f'kind = "{kind}"\n{size[kind]}\n'


def run(command, limit_s=resource.RLIM_INFINITY):
    return subprocess.run([str(word) for word in command], capture_output=True, text=True,
                          preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (limit_s, limit_s)))


def processor_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def meshed(name, tools_folder, folder):
    """The organ's mesh, once; its lowest and highest point under the tool."""
    x, y, edge, fine = organs.AIMS[name]
    points, triangles = organs.write_stl(folder / f"{name}.stl", organs.SHAPES[name])
    low, high = organs.span_along_z(points, triangles, x, y)
    mesh = folder / f"{name}.vtu"
    if not mesh.exists():
        for command in ([tools_folder / "palpate-surface", folder / f"{name}.stl", folder / f"{name}.vtp", "--edge", edge * 0.8, "--force", "--quiet"],
                        [tools_folder / "palpate-mesh", folder / f"{name}.vtp", mesh, "--edge", edge, f"--focus={x},{y},{high}",
                         "--focus-edge", fine, "--focus-radius", 0.45 * (high - low), "--quiet"]):
            done = run(command)
            if done.returncode:
                sys.exit(done.stderr)
    return mesh, low, high


def case_text(number, mesh, low, high, remesh, steps=8):
    organ, kind, law, nu, friction = combination(number)
    x, y, _, _ = organs.AIMS[organ]
    thickness = high - low
    return f"""schema = "palpate-case/1"
mesh = "{mesh.name}"
{material(law, nu)}
[base]
plane = {{ point_mm = [0.0, 0.0, {low + 0.2 * thickness}], normal = [0.0, 0.0, 1.0] }}

[tool]
{tool(kind, thickness)}aim_mm = [{x}, {y}, {low}]
axis = [0.0, 0.0, -1.0]
depth_mm = {0.4 * thickness}
friction = {friction}

[steps]
count = {steps}
frames = 1
{"[remesh]" if remesh else ""}
{"most_nodes = 3000" if remesh else ""}
"""


def balanced(facts):
    return facts["worst_force_imbalance"] <= MOST_FORCE and facts["worst_energy_imbalance"] <= MOST_ENERGY


def judged(facts, again):
    """Whether the answer is right, and words; `again()`: the facts of twice the steps."""
    if balanced(facts):
        return True, ""
    if facts["worst_force_imbalance"] <= MOST_FORCE and (finer := again()):
        if balanced(finer) and abs(finer["peak_force_N"] / facts["peak_force_N"] - 1) <= 1e-3:
            return True, f"energy in balance in 16 steps ({finer['worst_energy_imbalance']:.1e}; same force)"
    return False, "wrong: out of balance"


def main():
    tools_folder, folder = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    reached = 0
    words = sys.argv[3:]
    remesh = "remesh" in words
    numbers = [int(n) for n in words if n != "remesh"] or range(60)
    with open(folder / "table.csv", "a") as table, open(folder / "cases.jsonl", "a") as log:
        for number in numbers:
            organ, kind, law, nu, friction = combination(number)
            mesh, low, high = meshed(organ, tools_folder, folder)
            case, result = folder / f"case_{number:02}.toml", folder / f"case_{number:02}"
            case.write_text(case_text(number, mesh, low, high, remesh))
            begin = processor_seconds()
            done = run([tools_folder / "palpate-solve", case, result, "--force", "--quiet", "--threads", 1], LIMIT_S)
            seconds = processor_seconds() - begin
            row = [number, organ, kind, law, nu, friction, "time" if done.returncode < 0 else done.returncode, f"{seconds:.0f}"]
            if done.returncode == 0:
                facts = json.loads((result / "summary.json").read_text())
                row += [facts["iterations"], facts["cuts"], f"{facts['worst_force_imbalance']:.1e}", f"{facts['worst_penetration_of_element_size']:.4f}",
                        f"{facts['peak_force_N']:.4g}", facts["nodes"], f"{facts['worst_energy_imbalance']:.1e}"]

                def again():
                    case.write_text(case_text(number, mesh, low, high, remesh, 16))
                    done = run([tools_folder / "palpate-solve", case, result, "--force", "--quiet", "--threads", 1], LIMIT_S)
                    return json.loads((result / "summary.json").read_text()) if done.returncode == 0 else None

                right, words_of_it = judged(facts, again)
                row.append(words_of_it)
                reached += right
            else:
                row += ["", "", "", "", "", "", "", done.stderr.strip().replace("\n", " ").replace(",", ";")]
            line = ",".join(str(v) for v in row)
            for file, text in ((table, line), (log, json.dumps(dict(zip(COLUMNS, row))))):
                file.write(text + "\n")
                file.flush()
            print(line, flush=True)
    print(f"{reached} of {len(numbers)} reached full depth")


main()
