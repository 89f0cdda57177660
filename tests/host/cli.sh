#!/bin/sh
# SPDX-License-Identifier: MIT
# usage: cli.sh PROGRAM SCRATCH_FOLDER SOURCE_TREE
# The program run as people run it: what it prints and how it ends, for good and for bad input.
set -u
program=$1 tree=$3
mkdir -p "$2" && cd "$2" || exit 1
rm -rf ./*
failures=0

fail() {
    echo "FAILED: insole $call: $1"
    failures=$((failures + 1))
}

run() { # ARGUMENT... ; standard input from the file `input`
    call="$*"
    "$program" "$@" <input >out 2>err
    status=$?
}

status_is() {
    [ "$status" -eq "$1" ] || fail "exit $status, expected $1: $(cat err)"
}

is() { # FILE TEXT: the whole of it
    printf '%s\n' "$2" | cmp -s - "$1" || fail "$1 is
$(cat "$1")
instead of
$2"
}

has() { # FILE TEXT
    grep -qF -- "$2" "$1" || fail "$1 does not have \"$2\" but
$(cat "$1")"
}

lacks() { # FILE TEXT
    ! grep -qF -- "$2" "$1" || fail "$1 has \"$2\""
}

empty() {
    [ ! -s "$1" ] || fail "$1 is not empty: $(cat "$1")"
}

refuses() { # EXIT TEXT ARGUMENT... : this code, this text on stderr, nothing on stdout
    wanted=$1 text=$2
    shift 2
    run "$@"
    status_is "$wanted"
    is err "$text"
    empty out
}

# ---- logs ----------------------------------------------------------------------------------

: >input
# A foot that stands for 2 s, makes ten strides of 1.2 m in a bend, and stands again.
awk 'BEGIN {
    pi = 3.14159265358979
    for (i = 0; i <= 3000; i++) {
        t = i / 200; u = -1; k = int((t - 2) / 1.1)
        if (t > 2 && k < 10) u = (t - 2 - k * 1.1) / 0.6
        ax = 0; ay = 0; az = 9.81; wz = 0
        if (u > 0 && u < 1) {
            v = u * (1 - u)
            s = u * u * u * (10 - 15 * u + 6 * u * u)
            a = 1.2 * 60 * v * (1 - 2 * u) / 0.36
            ax = a * cos(0.6 * s); ay = -a * sin(0.6 * s)
            az += 6.4 * (6 * v * (1 - 2 * u) ^ 2 - 6 * v * v) / 0.36
            wz = 0.6 * 30 * v * v / 0.6
        }
        printf "imu,%.6f,%.6f,%.6f,%.6f,0,0,%.6f\n", t, ax, ay, az, wz
    }
}' >walk.csv
printf 't,x,y\n0,0,0\n15,0,0\n' >loop.csv
printf 't,x,y\n0,5,5\n' >one.csv
awk -F, '{ printf "%s,%s,%.6f,%.6f,%.6f,%s,%s,%.6f\n", $1, $2, $3 / 9.80665, $4 / 9.80665,
           $5 / 9.80665, $6, $7, $8 * 57.2957795 }' walk.csv >units.csv
printf 'imu,0,1,2\n' >bad.csv
: >empty.csv

# ---- the program ---------------------------------------------------------------------------

run --version; status_is 0; has out 'insole '; empty err
run --help; status_is 0; empty err
for command in replay score compare draw calibrate config plan pack stream radiomap train-carry; do
    has out "  $command "
    run "$command" --help; status_is 0; empty err; has out "insole $command"; has out 'Options'
    run help "$command"; status_is 0; has out "insole $command"
    run --help
done
run help files; status_is 0; has out 'imu,t,ax,ay,az,gx,gy,gz'
run; status_is 2; empty out; has err 'Commands'
refuses 2 'insole: unknown command relpay: did you mean replay?' relpay
refuses 2 'insole: unknown command xyzzy: `insole --help` lists them' xyzzy
refuses 2 'insole: unknown command xyzzy: `insole --help` lists them' help xyzzy

# No line of help is too wide for a terminal of 100 columns.
for command in replay score compare draw calibrate config plan pack stream radiomap train-carry files; do
    run help "$command"
    [ "$(awk 'length > 100' out | wc -l)" -eq 0 ] || fail 'lines of more than 100 columns'
done

# ---- replay: usage -------------------------------------------------------------------------

refuses 2 'insole replay: no log: expected files, folders or - for standard input' replay
refuses 2 'insole replay: unknown option --plt: did you mean --plot?' replay walk.csv --plt x
refuses 2 'insole replay: --out needs a value: --out FILE' replay walk.csv --out
refuses 2 'insole replay: --rate 5000: expected a number from 0 to 1000' replay walk.csv --rate 5000
refuses 2 'insole replay: --rate fast: expected a number from 0 to 1000' replay walk.csv --rate fast
refuses 2 'insole: --format xml: expected csv, tum or geojson' replay walk.csv --format xml
refuses 2 'insole: --align sim3: expected none, yaw or se2' replay walk.csv --align sim3
refuses 2 'insole: --method gps: expected ins, pdr, wifi, two-order or best' \
    replay walk.csv --method gps
refuses 2 'insole: --tracker hand: expected foot or phone' replay walk.csv --tracker hand
refuses 2 'insole: --method ekf: expected ins, pdr, wifi, two-order or best; with --tracker phone it is a method' \
    replay walk.csv --method ekf
refuses 2 'insole replay: --method wifi-kde needs fingerprints: --radiomap FILE' \
    replay walk.csv --tracker phone --method wifi-kde
refuses 2 'insole replay: --method zee needs walls: --plan FILE' \
    replay walk.csv --tracker phone --method zee
refuses 2 'insole replay: --lag is for the foot tracker' replay walk.csv --tracker phone --lag 1
refuses 2 'insole replay: --smooth is for the foot tracker' \
    replay walk.csv --tracker phone --smooth
refuses 2 'insole replay: --aps is for the foot tracker' \
    replay walk.csv --tracker phone --aps "$tree/maps/office/aps.csv"
refuses 2 'insole: --accel-unit ft: expected mps2, g or mg' replay walk.csv --accel-unit ft
refuses 2 'insole replay: --start 1: expected x,y or x,y,heading in m and rad' \
    replay walk.csv --start 1
refuses 2 'insole replay: --start 1,2,3,4: expected x,y or x,y,heading in m and rad' \
    replay walk.csv --start 1,2,3,4
refuses 2 'insole replay: --start and --no-start contradict each other' \
    replay walk.csv --start 1,2 --no-start
refuses 2 'insole replay: --set unknown key "colour": `insole config` lists all of them' \
    replay walk.csv --set colour=red
refuses 2 'insole replay: --set unknown key "sigma_zupt": did you mean zupt_ekf.sigma_zupt_mps?' \
    replay walk.csv --set sigma_zupt=1
refuses 2 'insole replay: --set zupt_ekf.sigma_zupt_mps: 9 is out of range: expected 0.0001 .. 1 m/s' \
    replay walk.csv --set zupt_ekf.sigma_zupt_mps=9
refuses 2 'insole replay: --set "method": expected key=value' replay walk.csv --set method
refuses 2 'insole replay: only one of --out -, --events -, --plot -, --report - and --json can have the standard output' \
    replay walk.csv --out - --json
refuses 2 'insole replay: --out walk.csv would overwrite what is read' \
    replay walk.csv --out walk.csv
refuses 2 'insole replay: --plot ./loop.csv would overwrite what is read' \
    replay walk.csv --truth loop.csv --plot ./loop.csv
[ "$(wc -l <walk.csv)" -eq 3001 ] || fail 'the log has been overwritten'

# ---- replay: bad input ---------------------------------------------------------------------

refuses 1 'bad.csv:1: too few fields: expected imu,t,ax,ay,az,gx,gy,gz' replay bad.csv
refuses 1 'absent.csv: cannot open: No such file or directory' replay walk.csv absent.csv
refuses 1 'empty.csv: no imu record in the session: expected imu,t,ax,ay,az,gx,gy,gz' \
    replay empty.csv
refuses 1 'stdin: no imu record in the session: expected imu,t,ax,ay,az,gx,gy,gz' replay -
refuses 1 'insole: the accelerometer looks like g (median of |a| is 1.00034): use --accel-unit g' \
    replay units.csv
refuses 1 'insole: the gyroscope looks like degrees per second (it keeps beyond 40 rad/s): use --gyro-unit dps' \
    replay units.csv --accel-unit g
refuses 1 'bad.csv:1: too few fields: expected imu,t,ax,ay,az,gx,gy,gz' \
    replay walk.csv --truth bad.csv
refuses 1 'no/track.csv: cannot write: No such file or directory' \
    replay walk.csv --out no/track.csv
printf 'a = 1\n' >bad.conf
refuses 1 'bad.conf:1: unknown key "a": `insole config` lists all of them' \
    replay walk.csv --config bad.conf
mkdir -p hollow
refuses 1 'hollow: folder has no log: expected .csv files' replay hollow
cat walk.csv bad.csv >torn.csv
run replay torn.csv --out torn.track.csv
status_is 1
is err 'torn.csv:3002: too few fields: expected imu,t,ax,ay,az,gx,gy,gz'

# ---- replay --------------------------------------------------------------------------------

run replay walk.csv --out track.csv --events events.csv --plot plot.svg
status_is 0; empty out
has err 'foot tracker, method best'
has err '  building       nothing known (--plan, --aps)'
has err '  duration       15.0 s, 3001 readings at 200.0 Hz'
has err ' in 10 strides'
has err '  refused        none'
has err '  the log lacks  start, mag, rss, range'
has err 'note: no start is known'
lacks err score
has track.csv 't,x,y,z,heading,var_x,cov_xy,var_y,var_z,var_heading,state'
[ "$(wc -l <track.csv)" -eq 152 ] || fail 'not a row for every 0.1 s'
[ "$(grep -c '^stride,' events.csv)" -eq 10 ] || fail 'not ten strides among the events'
has plot.svg '</svg>'

run replay walk.csv --truth loop.csv --report page.html
status_is 0; empty out
has page.html '<title>walk.csv</title>'
has page.html 'foot tracker, method best'
[ "$(grep -c '^<svg' page.html)" -eq 2 ] || fail 'not two pictures in the report'
refuses 2 'insole replay: --report loop.csv would overwrite what is read' \
    replay walk.csv --truth loop.csv --report loop.csv
refuses 1 'nowhere/page.html: cannot write: No such file or directory' replay walk.csv --report nowhere/page.html

run replay walk.csv
status_is 0; empty out
run replay walk.csv --method ins --out ins.csv
has err 'foot tracker, method ins'
cmp -s ins.csv track.csv || fail 'best without a building is not ins'
run replay walk.csv --out -
status_is 0
cmp -s out track.csv || fail 'standard output is not what --out writes'
cat walk.csv >input
run replay - --out -
cmp -s out track.csv || fail 'a log on standard input gives another track'
: >input
run replay walk.csv --out whole.csv --rate 0
[ "$(wc -l <whole.csv)" -eq 3002 ] || fail 'not a row for every reading'
run replay walk.csv --json
status_is 0; empty err
has out '"strides": 10,'
has out '"lacks": ['
run replay walk.csv --truth loop.csv --json
has out '"align": "se2"'
run replay walk.csv --truth loop.csv --start 0,0
has err '(turned about its start'
run replay walk.csv --truth one.csv --start 5,5,0.3
has err '(as it is)'
has err '  end               0.000 m'
run replay walk.csv --method pdr
has err 'foot tracker, method pdr'
run replay units.csv --accel-unit g --gyro-unit dps --out back.csv
status_is 0
has err ' in 10 strides'
run replay walk.csv --format tum --out -
[ "$(head -n 1 out)" = '0.000000 0.0000 0.0000 0.0000 0.0000000 0.0000000 0.0000000 1.0000000' ] ||
    fail "tum begins $(head -n 1 out)"
run replay walk.csv --format geojson --out -
has out '"type":"LineString"'
mkdir -p session
cp walk.csv session/imu.csv
printf 'truth,0,0,0\ntruth,14,9,9\n' >session/truth.csv
cp track.csv session/track.csv
run replay session --out from_folder.csv
status_is 0
cmp -s from_folder.csv track.csv || fail 'a folder gives another track than its log'
has err 'score against the truth'

# A row leaves as soon as it is known: half a second of log before the end must not be awaited.
mkfifo pipe 2>/dev/null && {
    call='replay - (a pipe that stays open)'
    "$program" replay - --out live.csv <pipe 2>/dev/null &
    reader=$!
    exec 9>pipe
    head -n 1001 walk.csv >&9
    tries=0
    until [ "$(wc -l <live.csv)" -ge 46 ] || [ "$tries" -ge 100 ]; do
        sleep 0.1 2>/dev/null || sleep 1
        tries=$((tries + 1))
    done
    rows=$(wc -l <live.csv)
    exec 9>&-
    wait $reader
    [ "$rows" -ge 46 ] || fail "only $rows rows of 5 s had left"
}

# A log may be a pipe with a name: it is opened once.
call='replay pipe'
cat walk.csv >pipe &
"$program" replay pipe --out piped.csv 2>err
cmp -s piped.csv track.csv || fail 'a log from a named pipe gives another track'
wait

# An older track stays where it is when the log is not there or the command is wrong.
cp track.csv kept.csv
run replay absent.csv --out kept.csv
cmp -s kept.csv track.csv || fail 'a missing log has cost an older track'
run replay walk.csv --out kept.csv --rate fast
cmp -s kept.csv track.csv || fail 'a wrong option has cost an older track'

if [ -w /dev/full ]; then
    run replay walk.csv --out /dev/full
    status_is 1
    is err '/dev/full: cannot write: No space left on device'
fi

# ---- replay: building and radio ------------------------------------------------------------

# A room about the walk, and radio that is heard once a second by three access points.
printf 'loss,4\noutline,-20,-20,20,-20,20,20,-20,20\n' >plan.csv
printf 'id,x,y\nA,-5,-5\nB,8,-5\nC,0,9\n' >aps.csv
printf 'id,x,y\nA;5,-5\n' >bad.aps.csv
awk 'BEGIN { for (t = 0; t < 15; t++)
    printf "rss,%d,A,-55\nrss,%d,B,-58\nrss,%d,C,-59,0.25\nrss,%d,X,-40\n", t, t, t, t }' >rss.csv
awk 'BEGIN { for (t = 0; t < 15; t++)
    printf "range,%d,A,8.1\nrange,%d,B,9.5,0.5\nrange,%d,C,9.1\n", t, t, t }' >range.csv

refuses 2 'insole replay: --particles 0: expected a whole number from 1 to 1000000' \
    replay walk.csv --particles 0
refuses 2 'insole replay: --particles 1e9: expected a whole number from 1 to 1000000' \
    replay walk.csv --particles 1e9
refuses 2 'insole replay: --particles 1000000000: expected a whole number from 1 to 1000000' \
    replay walk.csv --particles 1000000000
refuses 2 'insole replay: --seed red: expected a whole number' replay walk.csv --seed red
refuses 2 'insole replay: --lag -1: expected a number from 0 to 60' replay walk.csv --lag -1
refuses 2 'insole replay: --lag soon: expected a number from 0 to 60' replay walk.csv --lag soon
refuses 2 'insole replay: --lag needs a building: --plan FILE, --aps FILE or both' \
    replay walk.csv --lag 5
refuses 2 'insole replay: --lag is for best and two-order, not for ins' \
    replay walk.csv --plan plan.csv --method ins --lag 5
refuses 2 'insole replay: --method wifi needs access points: --aps FILE' \
    replay rss.csv --method wifi --plan plan.csv
refuses 2 'insole replay: --smooth is for ins and pdr: method best with a building looks back by --lag SECONDS' \
    replay walk.csv --plan plan.csv --smooth
refuses 2 'insole replay: --use sound: expected rss, range or rss,range' \
    replay walk.csv --use sound
refuses 2 'insole replay: --out plan.csv would overwrite what is read' \
    replay walk.csv --plan plan.csv --out plan.csv
refuses 2 'insole replay: --events ./aps.csv would overwrite what is read' \
    replay walk.csv --aps aps.csv --events ./aps.csv
refuses 1 'absent.csv: cannot open: No such file or directory' replay walk.csv --aps absent.csv
refuses 1 'absent.csv: cannot open: No such file or directory' replay walk.csv --plan absent.csv
run replay walk.csv --aps bad.aps.csv
status_is 1; empty out; has err 'bad.aps.csv:2: '
run replay walk.csv --plan rss.csv
status_is 1; empty out; has err 'rss.csv:1: '
refuses 1 'walk.csv: no rss or range record in the session: expected rss,t,id,dbm' \
    replay walk.csv --aps aps.csv --method wifi
refuses 1 'rss.csv: no imu record in the session: expected imu,t,ax,ay,az,gx,gy,gz' \
    replay rss.csv --aps aps.csv

run replay walk.csv rss.csv
status_is 0
has err 'note: the log hears 4 access points: their places (--aps FILE) would hold the track'
run replay walk.csv rss.csv --plan plan.csv --aps aps.csv --start 0,0,0.3 --out fused.csv \
    --events fused.events.csv --plot fused.svg
status_is 0; empty out
has err '  building       plan.csv (4 walls), aps.csv (3 access points)'
has err '  radio          15 scans, 0 ranges; worked in '
has err '1 of 4 ids unknown'
has err '  cloud          drawn 1 times'
has err '  receiver       hears '
has err '  states         align '
[ "$(wc -l <fused.csv)" -eq 152 ] || fail 'not a row for every 0.1 s'
for event in stance stride start scan; do
    has fused.events.csv "$event,"
done
run replay walk.csv rss.csv --plan plan.csv --aps aps.csv --start 0,0,0.3 --out again.csv --seed 1 \
    --particles 500 --use rss,range
cmp -s fused.csv again.csv || fail 'the defaults are not those of the help'
run replay walk.csv rss.csv --plan plan.csv --aps aps.csv --start 0,0,0.3 --out again.csv --seed 2
cmp -s fused.csv again.csv && fail 'another seed gives the same track'
run replay walk.csv rss.csv --plan plan.csv --aps aps.csv --start 0,0,0.3 --use range --json
status_is 0
has out '"scans": 0,'
run replay walk.csv rss.csv --plan plan.csv --aps aps.csv --start 0,0,0.3 --lag 3 --out late.csv
status_is 0
[ "$(wc -l <late.csv)" -eq 152 ] || fail 'not a row for every 0.1 s with a lag'
run replay walk.csv --plan plan.csv --start 600,0,0.3
status_is 0
has err 'note: the start lies outside the plan, 580.0 m from the nearest wall: are both of the same map?'
run replay walk.csv rss.csv --aps aps.csv --no-start
status_is 0
has err 'search '
lacks err 'no start is known'
run replay walk.csv --method two-order --start 0,0,0.3
status_is 0
has err '  building       nothing known (--plan, --aps)'
run compare walk.csv rss.csv --methods ins,wifi,two-order,best --aps aps.csv --start 0,0 --lag 2
status_is 0; empty err
[ "$(wc -l <out)" -eq 5 ] || fail 'not a line per method'

# Radio alone: a row for each scan; with an IMU, at the rate.
run replay rss.csv --aps aps.csv --method wifi --out radio.csv
status_is 0
[ "$(wc -l <radio.csv)" -eq 16 ] || fail 'not a row for every scan'
cat range.csv >input
run replay - --aps aps.csv --method wifi --out radio.csv --use range
status_is 0
has err '  radio          0 scans, 45 ranges; worked in 15 times'
[ "$(wc -l <radio.csv)" -eq 16 ] || fail 'not a row for every moment'
: >input
run replay walk.csv rss.csv --aps aps.csv --method wifi --out radio.csv --rate 5
[ "$(wc -l <radio.csv)" -eq 77 ] || fail 'not a row for every 0.2 s'

# A folder brings its building; what the command line tells counts more.
mkdir -p house other
cp walk.csv rss.csv plan.csv aps.csv house
cp walk.csv plan.csv other
run replay house --start 0,0,0.3 --out again.csv
status_is 0
cmp -s fused.csv again.csv || fail 'a folder gives another track than its files'
has err '  building       plan.csv (4 walls), aps.csv (3 access points)'
cp aps.csv two.csv
run replay house --start 0,0,0.3 --aps two.csv
has err '  building       plan.csv (4 walls), two.csv (3 access points)'
refuses 2 'insole replay: both house/plan.csv and other/plan.csv are there: choose by --plan FILE' \
    replay house other

# ---- score ---------------------------------------------------------------------------------

refuses 2 'insole score: expected two files, TRACK and TRUTH' score track.csv
refuses 1 'walk.csv: holds no place: expected a header such as t,x,y or lines truth,t,x,y[,z]' \
    score walk.csv loop.csv
refuses 2 'insole: --align best: expected none, yaw or se2' score track.csv loop.csv --align best
printf 't,x,y\n1,0,0\n0,0,0\n' >back.truth.csv
refuses 1 'back.truth.csv:3: time goes back: expected places in order of time' \
    score track.csv back.truth.csv
run score track.csv track.csv
status_is 0; empty err
has out '  max               0.000 m'
has out '  points              151'
run score track.csv loop.csv --align se2 --json
status_is 0
has out '"align": "se2"'

# ---- compare -------------------------------------------------------------------------------

refuses 2 'insole compare: expected --methods A,B' compare walk.csv
refuses 2 'insole: --method gps: expected ins, pdr, wifi, two-order or best' \
    compare walk.csv --methods ins,gps
run compare walk.csv --methods ins,pdr --truth loop.csv --plot both.svg
status_is 0; empty err
[ "$(wc -l <out)" -eq 3 ] || fail 'not a line per method'
has out 'rms m'
has both.svg '>pdr<'
run compare walk.csv --methods ins,pdr --json
status_is 0
has out '"method": "pdr"'

# ---- config --------------------------------------------------------------------------------

refuses 2 'insole config: takes no operands, only --doc' config all
run config
status_is 0; empty err
has out 'zupt_ekf.sigma_zupt_mps = 0.'
cp out default.conf
run replay walk.csv --config default.conf --out again.csv
status_is 0
cmp -s again.csv track.csv || fail 'the printed defaults give another track'
run config --doc
has out '| `foot_tracker.method` | ins |'
run replay walk.csv --config default.conf --set stride.min_length_m=2
status_is 0
lacks err ' in 10 strides'

# ---- calibrate -----------------------------------------------------------------------------

refuses 2 'insole calibrate nothing: expected imu, stride, gyro-scale, pathloss, steplength or compass' calibrate
refuses 2 'insole calibrate magnet: expected imu, stride, gyro-scale, pathloss, steplength or compass' calibrate magnet walk.csv
refuses 2 'insole calibrate imu: no log: expected one or more' calibrate imu
refuses 2 'insole calibrate gyro-scale: expected one LOG and --turns N' calibrate gyro-scale walk.csv
refuses 2 'insole calibrate pathloss: no access points: expected --aps FILE, and --plan FILE where there are walls' \
    calibrate pathloss walk.csv
printf 'id,x,y\nlobby,5,3\n' >near.csv
refuses 1 'walk.csv: no truth: a survey tells where it was made, by truth records or a file t,x,y in the same folder' \
    calibrate pathloss walk.csv --aps near.csv
awk 'BEGIN { print "truth,0,0,0"; print "truth,30,30,0"
    for (t = 0; t <= 30; t += 0.5)
        printf "rss,%.1f,lobby,%.0f\n", t, -42 - 10 * log((t - 5) ^ 2 + 15.25) / log(10) }' >heard.csv
run calibrate pathloss heard.csv --aps near.csv --out fitted.csv
status_is 0; empty err
has out '# calibrate pathloss: 61 readings, 61 scans, 1 session'
has out 'propagation.p0_dbm = -'
has fitted.csv 'id,x,y,z,p0_dbm,exponent,near_dbm'
has fitted.csv 'lobby,5.000,3.000,2.500,-'
refuses 2 'insole calibrate pathloss: --out near.csv would overwrite what is read' \
    calibrate pathloss heard.csv --aps near.csv --out near.csv
run calibrate imu walk.csv
status_is 1; empty out
has err 'walk.csv: the sensor moves 2.0 s into the log'
run calibrate stride walk.csv
status_is 0; empty err
has out 'stride.k_stride = 0.'
cp out stride.conf
run replay walk.csv --method pdr --config stride.conf
status_is 0
head -n 390 walk.csv >rest.csv
run calibrate imu rest.csv
status_is 1
has err 'rest.csv: shorter than 2 s'

# ---- radio map -----------------------------------------------------------------------------

mkdir -p surveyed
printf 't,x,y\n0,1,1\n20,21,1\n' >surveyed/truth.csv
printf 'rss,2,b,-60,0.4\nrss,2,a,-71,0.5\nrss,12,b,-80\nrss,12,c,-50\nrss,12,d,nan\nrss,30,a,-50\n' \
    >surveyed/radio.csv
run radiomap surveyed --out surveyed/radiomap.csv
status_is 0
empty out
has err 'radio map: 2 points, 3 access points, 4 entries, 2.0 per point'
has err '  4 readings in 2 scans of 1 session'
has err '  left out: 1 readings outside the truth'
has err '  left out: 1 readings without a number'
is surveyed/radiomap.csv 'x,y,id,mean_dbm,std_dbm,count
3.000,1.000,a,-71.0,0.000,1
3.000,1.000,b,-60.0,0.000,1
13.000,1.000,b,-80.0,0.000,1
13.000,1.000,c,-50.0,0.000,1'
cp surveyed/radiomap.csv before.csv
run radiomap surveyed --out surveyed/radiomap.csv # the map in the folder is no log
status_is 0
cmp -s before.csv surveyed/radiomap.csv || fail 'made another map the second time'
run radiomap surveyed --keep 1 --late 0 --ahead 0.5 --out -
status_is 0
is out 'x,y,id,mean_dbm,std_dbm,count
3.100,1.000,b,-60.0,0.000,1
13.500,1.000,c,-50.0,0.000,1'
refuses 2 'insole radiomap: no survey: expected files or folders with rss and truth records' \
    radiomap --out r.csv
refuses 2 'insole radiomap: no --out: expected --out FILE' radiomap surveyed
refuses 2 'insole radiomap: --out surveyed/radio.csv would overwrite what is read' \
    radiomap surveyed --out surveyed/radio.csv
refuses 2 'insole radiomap: --spacing 0: expected a number from 0.05 to 1000' \
    radiomap surveyed --spacing 0 --out r.csv
refuses 2 'insole radiomap: --keep 0: expected a whole number from 1 to 65535' \
    radiomap surveyed --keep 0 --out r.csv
refuses 1 'absent: cannot open: No such file or directory' radiomap absent --out r.csv
[ ! -e r.csv ] || fail 'wrote r.csv'

# ---- plan and pack -------------------------------------------------------------------------

printf 'outline,0,0,20,0,20,10,0,10\nwall,5,10,0,10,4\nwall,5,10,5.2,10,10\n' >plan.csv
printf 'id,x,y\nlobby,1,1\noffice,19,9\n' >aps.csv
printf 'outline,0,0,20,0,0,10,20,10\n' >crossed.csv
printf 'outline,0,0,20,0\n' >open.csv
printf 'id,x,y\nlobby,1,1\nlobby,19,9\n' >twice.csv
refuses 2 'insole plan nothing: expected check or draw' plan
refuses 2 'insole plan paint: expected check or draw' plan paint plan.csv
refuses 2 'insole plan check: expected one file, PLAN' plan check
refuses 2 'insole plan draw: expected one file, PLAN' plan draw plan.csv aps.csv --out x.svg
refuses 2 'insole plan draw: no --out: expected --out FILE' plan draw plan.csv
refuses 2 'insole plan check: --out is of draw' plan check plan.csv --out x.svg
refuses 2 'insole plan: --out ./aps.csv would overwrite what is read' \
    plan draw plan.csv --aps aps.csv --out ./aps.csv
refuses 1 'absent.csv: cannot open: No such file or directory' plan check absent.csv
refuses 1 'open.csv:1: outline of 2 points: expected at least 3, outline,x,y,x,y,...' \
    plan check open.csv
refuses 1 'twice.csv:3: id "lobby" comes twice: it is that of line 2' \
    plan check plan.csv --aps twice.csv
run plan check plan.csv --aps aps.csv
status_is 0; empty err
has out 'plan.csv: 20.0 x 10.0 m, 200 m^2 to walk on, 6 walls, 1 part'
has out 'plan.csv: grid of 5 x 3 cells of 4.7 m, '
has out 'aps.csv: 2 access points'
has out '0 errors, 0 warnings'
cp plan.csv input
run plan check -; status_is 0; has out 'stdin: 20.0 x 10.0 m'
: >input
run plan check crossed.csv
status_is 1; empty err
has out 'crossed.csv:1: error: outline crosses itself near 10.00,5.00'
has out '1 error, '
run plan draw plan.csv --aps aps.csv --out plan.svg
status_is 0; empty out; empty err
has plan.svg '>lobby<'
run plan draw plan.csv --out -; status_is 0; has out '</svg>'
refuses 2 'insole pack: nothing to pack: expected --plan, --aps or --radiomap' pack --out site.c
refuses 2 'insole pack: no --out: expected --out FILE' pack --plan plan.csv
refuses 2 'insole pack: takes no operands, only --plan, --aps and --radiomap' pack plan.csv --out site.c
refuses 2 'insole pack: --name 2nd: expected a letter, then letters, digits and underscores, at most 40' \
    pack --plan plan.csv --name 2nd --out site.c
refuses 2 'insole pack: --out plan.csv would overwrite what is read' \
    pack --plan plan.csv --out plan.csv
refuses 1 'crossed.csv: 1 error: `insole plan check` tells what is wrong' \
    pack --plan crossed.csv --out site.c
[ ! -e site.c ] || fail 'a refusal has left a file'
run pack --plan plan.csv --aps aps.csv --out site.c
status_is 0; empty out; empty err
has site.c 'const insole_floor_plan_t site_plan = {'
has site.c '"lobby",'
run pack --aps aps.csv --name hall --out -; status_is 0; has out 'hall_aps[2]'
run pack --radiomap surveyed/radiomap.csv --out -; status_is 0
has out 'extern const insole_radio_map_t site_map;'; has out '    "c",'; lacks out 'site_aps['; lacks out site_plan
refuses 1 'aps.csv:1: header has no column mean_dbm: expected x,y,id,mean_dbm,std_dbm,count, of which x,y,id,mean_dbm must be there' \
    pack --radiomap aps.csv --out site.c

# ---- stream and draw: what devices are told and say ------------------------------------------

refuses 2 'insole stream: no log: expected files, folders or - for standard input' stream --out a.bin
refuses 2 'insole stream: no --out: expected --out FILE' stream walk.csv
refuses 2 'insole stream: --reset soon: expected seconds such as 12.5' \
    stream walk.csv --reset soon --out a.bin
refuses 2 'insole stream: --batch 16: expected a whole number from 1 to 15' \
    stream walk.csv --batch 16 --out a.bin
refuses 2 'insole stream: --every 0: expected a whole number from 1 to 65535' \
    stream walk.csv --every 0 --out a.bin
refuses 2 'insole stream: --out walk.csv would overwrite what is read' stream walk.csv --out walk.csv
refuses 1 'bad.csv:1: too few fields: expected imu,t,ax,ay,az,gx,gy,gz' stream bad.csv --out a.bin
[ ! -e a.bin ] || fail 'a refusal has left a file'
run stream walk.csv --out walk.bin
status_is 0; empty out; has err 'readings, 0 scans, 0 ranges'
[ "$(od -An -tx1 -N3 walk.bin)" = ' a5 48 24' ] || fail 'a stream does not begin with a head'
cp walk.bin kept.bin; cp walk.csv torn.csv; printf 'imu,1e6\n' >>torn.csv
run stream torn.csv --out kept.bin; status_is 1
cmp -s kept.bin walk.bin || fail 'a log that breaks off has cost an older stream'
run stream walk.csv --accel-range 1 --out a.bin; status_is 0; has err '  clipped: '
printf 'rss,1,lobby,-50\nrss,1,nowhere,-60\n' >heard.csv
run stream walk.csv heard.csv --aps aps.csv --out a.bin; status_is 0; has err ' 1 scans,'
run stream walk.csv heard.csv --out a.bin; status_is 0; has err ' 0 scans,'
refuses 2 'insole draw: expected one to 6 tracks' draw --out a.svg
refuses 2 'insole draw: no --out: expected --out FILE' draw loop.csv
refuses 2 'insole draw: --out loop.csv would overwrite what is read' draw loop.csv --out loop.csv
refuses 1 'walk.csv: holds no place: expected a header such as t,x,y or lines truth,t,x,y[,z]' \
    draw walk.csv --out a.svg
[ ! -e a.svg ] || fail 'a refusal has left a file'
run draw loop.csv --plan plan.csv --aps aps.csv --truth loop.csv --out a.svg
status_is 0; empty out; empty err; has a.svg '>lobby<'; has a.svg 'rms 0.00 m'
run draw loop.csv one.csv --out -; status_is 0; has out '>one.csv<'; has out '</svg>'
printf 'wall,5,10,0,10,4\n' >walls.csv
for call in "pack --plan walls.csv --out site.c" "replay walk.csv --plan walls.csv"; do
    refuses 1 'walls.csv: no outline: expected a ring around where one can walk' $call
done
run plan check walls.csv; status_is 1
has out 'error: no outline: expected a ring around where one can walk'
mkdir -p mapped
cp walk.csv surveyed/radiomap.csv mapped
run replay mapped --out with.csv; status_is 0; lacks err 'radio map'
run replay walk.csv --out without.csv; cmp -s with.csv without.csv || fail 'the foot took the map'
run replay walk.csv --radiomap surveyed/radiomap.csv --out with.csv; status_is 0
has err 'the radio map is left aside: the foot tracker takes none'
cmp -s with.csv without.csv || fail 'the foot took the map'
refuses 1 'absent.csv: cannot open: No such file or directory' replay walk.csv --radiomap absent.csv
refuses 2 'insole replay: --out surveyed/radiomap.csv would overwrite what is read' \
    replay walk.csv --plan plan.csv --radiomap surveyed/radiomap.csv --out surveyed/radiomap.csv

# ---- train-carry ---------------------------------------------------------------------------

# A phone that bounces `a` m/s^2 and sways `b`, turned by nothing.
carried() {
    awk -v a="$1" -v b="$2" 'BEGIN {
        print "t,ax,ay,az"
        for (i = 0; i < 3000; i++)
            printf "%.2f,%.3f,%.3f,%.3f\n", i * 0.02, b * sin(0.12 * i), 0.5 * cos(0.6 * i),
                9.8 + a * sin(0.24 * i + 0.001 * i * sin(i))
    }'
}
carried 2 0.3 >hand1.csv; carried 2.4 0.5 >hand2.csv
carried 5 3 >pocket1.csv; carried 6 3.5 >pocket2.csv
printf 'file,person,position\nhand1.csv,ann,inhand\npocket1.csv,ann,pocket\n' >people.csv
printf 'hand2.csv,bob,hand\npocket2.csv,bob,pocket\n' >>people.csv
printf 'file,person,position\nhand1.csv,ann,hand\n' >lonely.csv
printf 'file,position\nhand1.csv,hand\n' >nobody.csv
hands='hand=hand+inhand,pocket'
refuses 2 'insole train-carry: expected one INDEX' train-carry
refuses 2 'insole train-carry: --depth 8: expected a whole number from 1 to 7' \
    train-carry people.csv --depth 8
refuses 2 'insole train-carry: --features some: expected paper, accel or all' \
    train-carry people.csv --features some
refuses 2 'insole train-carry: --name 2nd: expected a letter, then letters, digits and underscores, at most 40' \
    train-carry people.csv --name 2nd
refuses 2 'insole train-carry: --out ./people.csv would overwrite what is read' \
    train-carry people.csv --out ./people.csv
refuses 1 'absent.csv: cannot open: No such file or directory' train-carry absent.csv
refuses 1 'nobody.csv:1: header is not of an index: expected the columns file,person,position' \
    train-carry nobody.csv
run train-carry lonely.csv; status_is 1
has err 'insole train-carry: only one position, hand: expected two or more'
run train-carry people.csv --leave-out carl --classes "$hands"; status_is 2
has err 'insole train-carry: --leave-out carl: nobody of that name'
run train-carry people.csv --leave-out each --classes "$hands" --trees 9 --out forest.c
status_is 0; empty err
has out 'Held out: ann'
has out 'Held out: bob'
has out '9 trees, '
has forest.c 'const insole_carry_forest_t carry_forest = {'
has forest.c 'static const char *const carry_names[2] = {"hand", "pocket"};'
run train-carry people.csv --classes "$hands" --trees 9 --out -
status_is 0; has err 'Out of bag'; cmp out forest.c || fail 'not the same table'
run train-carry people.csv --leave-out ann --classes "$hands"; status_is 0; has out 'Held out'
run train-carry people.csv --test people.csv --classes "$hands"; status_is 0; has out 'Held out'

# ---- simulate, in builds that have it ------------------------------------------------------

run --help
if grep -q '^  simulate ' out; then
    refuses 2 'insole simulate: expected one SCENARIO and --out DIR' simulate
    refuses 2 'insole simulate: --seed x: expected a whole number' simulate a --out b --seed x
    run simulate absent.scenario --out simulated
    status_is 1
    has err 'absent.scenario'
    run simulate "$tree/maps/demo/scenario" --out simulated --seed 7
    status_is 0; empty out
    has err 'simulated '
    cp simulated/log.csv once.csv
    run simulate "$tree/maps/demo/scenario" --out simulated --seed 7
    cmp -s simulated/log.csv once.csv || fail 'equal seeds give unequal walks'
    run replay simulated
    status_is 0
    has err '(as it is)'

    refuses 2 'insole reproduce: expected the name of one paper' reproduce
    refuses 2 'insole reproduce: expected the name of one paper' reproduce TwoOrder PhoneEKF
    refuses 2 'insole reproduce: unknown paper Twoorder: expected TwoOrder, PhoneEKF, PhoneUKF, WifiShift' \
        reproduce Twoorder
    refuses 2 'insole reproduce: --runs 0: expected a whole number from 1 to 1000' \
        reproduce TwoOrder --runs 0
    run reproduce TwoOrder --maps absent --runs 1
    status_is 1; empty out
    has err 'absent/student_centre/two_order.scenario'
    has err '--maps DIR tells where the maps are'
    run reproduce TwoOrder --maps "$tree/maps" --runs 1 --seed 5 --out figures
    status_is 0; empty err
    has out 'TwoOrder] table 3, 1 simulated walk of student_centre/two_order.scenario, seed 5'
    has out 'two-order against INS+EKF: mean '
    for figure in 5 6a 6b 7; do
        [ -s "figures/figure$figure.svg" ] || fail "no figure$figure.svg"
    done
    run reproduce TwoOrder --maps "$tree/maps" --runs 1 --json
    status_is 0; empty err
    has out '"label": "two-order"'
    has out '"share_lower": '
    run reproduce PhoneEKF --maps "$tree/maps" --runs 1 --seed 5 --json
    status_is 0; empty err
    has out '"label": "proposed EKF"'
    has out '"std_m": '
    refuses 2 'insole reproduce: TwoOrder has nothing to --search' reproduce TwoOrder --search
    refuses 2 'insole reproduce: WifiShift has nothing to --search' reproduce WifiShift --search
fi

[ "$failures" -eq 0 ] && echo 'cli: fine'
exit "$failures"
