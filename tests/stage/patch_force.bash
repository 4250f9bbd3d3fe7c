# A soft block pushed down 6 mm by a square patch of its top, by palpate-solve and by CalculiX on the same tetrahedra (quadratic there):
# the force of the patch. Sourced by tests/stage/export.sh and bench/calculix.
# SPDX-License-Identifier: GPL-3.0-or-later

# law_of <law>: its parameters as lines of a case, and its initial shear modulus in MPa behind a '#'.
law_of() {
  case $1 in
    neo_hookean) printf 'mu = 0.0067\n#0.0067\n' ;;
    mooney_rivlin) printf 'C10 = 0.083\nC01 = 0.0565\n#0.279\n' ;;
    ogden) printf 'mu1 = 0.004\nalpha1 = 3\nmu2 = 0.002\nalpha2 = -4\nmu3 = 0.0007\nalpha3 = 8\n#0.0067\n' ;;
    yeoh) printf 'C10 = 0.0034\nC20 = 0.0012\nC30 = 0.0005\n#0.0068\n' ;;
  esac
}

# write_case <law> <bulk modulus over shear modulus, or "incompressible"> <steps> <half the patch, mm, whole> [quarter]: case.toml on stdout, of
# the block or of its quarter x, y > 0.
write_case() {
  local shear
  shear=$(law_of "$1" | sed -n 's/^#//p')
  printf 'schema = "palpate-case/1"\n[material]\nlaw = "%s"\n' "$1"
  law_of "$1" | grep -v '^#'
  [ "$2" = incompressible ] || awk -v r="$2" -v m="$shear" 'BEGIN { printf "kappa = %.12g\n", r * m }'
  cat <<CASE
[base]
plane = { point_mm = [0.0, 0.0, 0.001], normal = [0.0, 0.0, 1.0] }
[[displacement]]
box = { min_mm = [-$4.001, -$4.001, 19.999], max_mm = [$4.001, $4.001, 20.001] }
motion_mm = [0.0, 0.0, -6.0]
[steps]
count = $3
frames = 1
CASE
  [ "${5:-}" != quarter ] || for normal in "1.0, 0.0, 0.0" "0.0, 1.0, 0.0"; do
    printf '[[symmetry]]\nplane = { point_mm = [0.0, 0.0, 0.0], normal = [%s] }\n' "$normal"
  done
}

# Both print the force at 6 mm in N and the processor seconds it took, in <folder>, of case.toml there and the mesh named.
# ours <bin> <folder> <mesh> <threads>
ours() {
  local TIMEFORMAT='%U %S'
  { time OPENBLAS_NUM_THREADS=$4 "$1/palpate-solve" "$2/case.toml" "$2/result" --mesh "$3" --threads "$4" --quiet --force </dev/null >"$2/solve.log" 2>&1; } 2>"$2/time"
  awk -F, -v took="$(awk '{ print $1 + $2 }' "$2/time")" 'END { if (!($2 > 5.9999)) exit 1; printf "%.8g %.2f\n", $6, took }' "$2/result/history.csv"
}

# theirs <bin> <folder> <mesh> <threads>
theirs() {
  "$1/palpate-export" "$2/case.toml" "$2/model.inp" --mesh "$3" --quiet --force </dev/null
  local TIMEFORMAT='%U %S'
  { time (cd "$2" && OMP_NUM_THREADS=$4 CCX_NPROC_EQUATION_SOLVER=$4 OPENBLAS_NUM_THREADS=$4 ccx -i model </dev/null >ccx.log 2>&1); } 2>"$2/time"
  awk -v took="$(awk '{ print $1 + $2 }' "$2/time")" '
    /total force.*MOVED1/ { time = $NF; getline; getline; force = -$3 }
    END { if (!(time > 0.999999)) exit 1; printf "%.8g %.2f\n", force, took }' "$2/model.dat"
}
