# A coarse tube and its closing in a few seconds, for tests of the clamp: clamp_case FILE BIN [WALL] writes FILE.vtp, FILE.vtu and FILE.toml.
# SPDX-License-Identifier: GPL-3.0-or-later
clamp_case() {
  local name=$1 bin=$2 wall=${3:-1.2}
  [ -e tube.vtp ] || "$bin/palpate-idealize" tube.vtp --diameter 25 --length 60 --edge 1.5 --quiet
  "$bin/palpate-mesh" tube.vtp "$name.vtu" --kind shell --thickness "$wall" "${@:4}" --quiet
  cat > "$name.toml" <<TOML
schema = "palpate-case/1"
scheme = "explicit"
mesh = "$name.vtu"
[material]
law = "mooney_rivlin"
C10 = 0.083
C01 = 0.0565
[clamp]
centre_mm = [0, 0, 30]
speed_mm_s = 400
[steps]
frames = 2
rows = 20
TOML
}
