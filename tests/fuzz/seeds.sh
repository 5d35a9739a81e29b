#!/bin/sh
# Writes small seeds for the programs that have no folder of fixtures of their own, one folder a
# program: tests/fuzz/seeds.sh FOLDER [SESSION]. SESSION is a folder that `encore profile` wrote.
set -eu
fixtures=$(cd "$(dirname "$0")/../fixtures" && pwd)
session=$(cd "${2:-.}" && pwd)
assets=$(cd "$(dirname "$0")/../../assets" && pwd)
mkdir -p "$1" && cd "$1"
mkdir -p meter recording calibration battery_toml study_toml specs session sysfs

# The first byte picks the parser (see each program).
for stream in "$fixtures"/meters/*.bin; do
  { printf 0; cat "$stream"; } > "meter/$(basename "$stream")"
done
for kind in 1 2 3; do
  { printf %s $kind; cat "$fixtures/meters/scpi_answers.txt"; } > "meter/scpi_$kind"
done

printf 'time_s,watts\n0,20\n1,21.5\n2,\n3,nan\n4,30\n40,31\n41,32\n' > recording/watts.csv
printf 'Time (ms);Energy [mWh];Power(mW)\n0;1,5;2000\n500;1,6;+2e3\n' > recording/german.csv
printf '\357\273\277# by a meter\nt_h\tvolts\tcurrent_ma\n0\t19.5\t500\n1e-3\t19\t600\n' \
  > recording/tabs.tsv
printf 't,joules,p_kw\n1,5,1\n2,9,1\n3,2,1\n4,7,1\n' > recording/reset.csv

cat > calibration/whole.toml << 'END'
format = 1
idle_W = 19.0
relative_uncertainty = 0.03
machine = "m"
measured_utc = "2026-01-31T12:00:00Z"
method = "regression"
[above_idle]
animate_W = 15.0
build_W = 14
update_W = 14.6
transfer_W = 9e0
render_W = 15.6
gpu_W = 21.2
END

cat > battery_toml/whole.toml << 'END'
[battery]
name = "two cells"
capacity_ah = 2.0
capacity_wh = 14.6
nominal_v = 7.4
cutoff_v = 6.2
soc = 0.8
series = 2
parallel = 1
peukert_runs = [{amperes = 1, minutes = 120}, {amperes = 2, minutes = 58}]
rated_hours = 10
kinetic_c = 0.5
kinetic_rate_per_s = 1e-3
kinetic_capacity_ah = 2.2
[battery.cell]
r0_ohm = 0.02
rc = [{ohm = 0.01, farad = 100}]
ocv = [[0, 3.0], [0.5, 3.7], [1, 4.2]]
END
printf '[battery]\npreset = "thesis-laptop"\nsoc = 0.5\npeukert_exponent = 1.1\n' \
  > battery_toml/preset.toml
printf '[battery]\nnominal_v = 11.1\ncapacity_wh = 53\n' > battery_toml/label.toml

cp "$assets"/studies/*.toml study_toml/
cat > study_toml/whole.toml << 'END'
name = "n"
source = ["rapl", "nvml:0"]
model = "idle=1,build=2"
search_path = "models"
[plan]
name = "thesis"
seconds = 30
idle_s = 2.5
until = "2%"
repeats = 4
order = "abba"
seed = 7
[[group]]
name = "g"
device = "cpu"
scenes = ["toys", "cow"]
structures = "grid-box"
policies = ["rebuild", "refit"]
tests = ["build", "forced"]
sizes = [128, "640x480"]
memory = ["malloc", "pool"]
update_cases = ["best"]
set = ["grid.cells_per_axis=16"]
threads = 2
END

n=0
for spec in 0idle=12,render=20,build=18W 0idle=12,max=45 '0thesis-laptop, transfer=10' \
  0idle=1,busy=2,gpu=3,uncertainty=10% 1rapl:package-0 1model 1meter:um25c:/dev/rfcomm0:baud=9600 \
  '1meter:scpi:/dev/ttyUSB0:volts=19.5:query=MEAS1?' 1meter:scpi:COM:1:amps=.5 \
  1replay:a:b.csv:offset=-1.5; do
  n=$((n + 1))
  printf %s "$spec" > "specs/$n"
done

for pack in "$fixtures"/sysfs/bat_*/sys/class/power_supply/BAT*/uevent; do
  n=$((n + 1))
  { printf 0; cat "$pack"; } > "sysfs/uevent_$n"
done
printf '1cpu 1 2 3 4 5 6 7 8 0 0\ncpu0 1 2 3 4\n-\ncpu 2 2 3 9 5 6 7 9 0 0\ncpu0 1 2 3 9\n' \
  > sysfs/stat
printf 20-3,8 > sysfs/list
printf '30,18\nevent=0x02\n2.3283064365386962890625e-10\nJoules\n31\n0\n' > sysfs/pmu

# The files of a session, if one is given, each behind the byte that names it.
if [ $# -gt 1 ]; then
  n=0
  for file in session.toml frames.csv summary.csv phases.csv windows.csv convergence.csv \
    samples.csv events.csv; do
    { printf $n; head -n 200 "$session/$file" | head -c 16384; } > "session/$file"
    n=$((n + 1))
  done
fi
