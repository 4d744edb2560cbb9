#!/usr/bin/env bash
# write_example_reports.sh PROGRAM SOURCES FOLDER: writes compare.html, sweep.html, identify.html,
# diagnose.html and plan.html into FOLDER, each as the command writes it, from small examples.
set -euo pipefail
program=$1 sources=$2 folder=$3
mkdir -p "$folder"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

run() {  # a measurement that differs from the model ends compare with status 1
  "$program" "$@" >output 2>errors || [[ $? -eq 1 && $1 == compare ]] || { cat errors >&2; exit 1; }
  case $* in
    *--report*) tail -n 1 output | grep -qx 'wrote .*\.html' || { echo "no last line: $*" >&2; exit 1; } ;;
  esac
}

{ cat "$sources/data/paper/arm.toml"; printf '\n[damping]\nkelvin_voigt = 1e-4\n'; } >damped.toml
{ cat damped.toml; printf '\n[effects.coulomb_friction]\ntorque = 0.008\n'; } >friction.toml
run simulate friction.toml --out friction --modes 8 --duration 4 --period 0.002 --noise 0.005 \
  --excitation random:rms=0.04,to=60,id=low --excitation random:rms=0.12,to=60,id=high \
  --excitation multisine:rms=0.06,from=0.5,to=60,id=multisine \
  --sensor hub_angle,hub_velocity,tip_acceleration
cp damped.toml friction/arm.toml
run diagnose friction/measurement.toml --report "$folder/diagnose.html" \
  --effects coulomb_friction,time_delay,hub_inertia,root_compliance,payload_mass
run simulate damped.toml --out modal --payload-mass 0.06 --duration 30 --period 0.005 --noise 0.005 \
  --excitation random:rms=0.1,from=0.2,to=50,id=random --sensor hub_angle,tip_acceleration
run identify modal/measurement.toml --report "$folder/identify.html"
run compare "$sources/data/paper/arm.toml" --measured "$sources/data/paper/modal.csv" \
  --poles 6 --zeros 4 --report "$folder/compare.html"
run sweep "$sources/data/paper/arm.toml" --over payload.mass=0:0.3:41 --poles 4 --zeros 3 \
  --report "$folder/sweep.html"
run plan "$sources/data/plans/arm.toml" "$sources/data/plans/modal-table.toml" \
  --effects payload_mass,payload_inertia,hub_inertia,root_compliance,shear_and_rotary_inertia \
  --report "$folder/plan.html"
