//! The command `twofold timing` as a user meets it: files, numbers in them, refusals.

use std::fs;
use std::path::Path;

use crate::common::{folder, has_all, names_in, refuses, stderr, stdout, succeeds, twofold};
use twofold::epoch::Epoch;
use twofold::observables::pulsar::SpinFit;
use twofold_scene::pulsar_timing::PulsarScene;
use twofold_scene::scene_file::{PULSARS, Scene};
use twofold_scene::trajectory;
use twofold_verify::double_double::DoubleDouble;

fn written(args: &[&str], out: &Path) -> String {
    let output = succeeds(&[&["timing"], args, &["--out", out.to_str().expect("path in UTF-8")]].concat());
    stdout(&output)
}

fn read(out: &Path, name: &str) -> String {
    fs::read_to_string(out.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

fn rows(csv: &str) -> Vec<Vec<f64>> {
    let number = |text: &str| if text.is_empty() { f64::NAN } else { text.parse().expect("a number") };
    csv.lines().skip(1).map(|line| line.split(',').map(number).collect()).collect()
}

#[test]
fn every_built_in_pulsar_is_timed_and_runs() {
    for built_in in PULSARS {
        let scene = Scene::named(built_in.name).unwrap_or_else(|error| panic!("{error}"));
        assert!(!scene.about.is_empty() && scene.about.len() < 100 && scene.sources.len() >= 3, "{}", built_in.name);
        let summary = trajectory::write_csv(&scene, std::io::sink(), |_| {}).expect(built_in.name);
        assert_eq!(summary.rows, 1000, "{}", built_in.name);
        let out = folder();
        written(&[built_in.name, "--epochs", "50"], out.path());
        let endings = ["csv", "h_cross.txt", "h_plus.txt", "par", "tim"];
        assert_eq!(names_in(out.path()), endings.map(|ending| format!("{}.{ending}", built_in.name)));
        let csv = read(out.path(), &format!("{}.csv", built_in.name));
        assert_eq!(rows(&csv).len(), 50, "{}: the pulse is always seen", built_in.name);
        // The pulse frequency is the one published.
        let published = built_in.toml.lines().find(|line| line.starts_with("spin_frequency")).expect("a frequency");
        let digits = |text: &str| {
            text.split(|c: char| !c.is_ascii_digit() && c != '.').find_map(|part| part.parse::<f64>().ok())
        };
        let (value, comment) = published.split_once('=').and_then(|(_, rest)| rest.split_once('#')).expect("a comment");
        let published = comment.split_once("F0 = ").and_then(|(_, rest)| digits(rest)).or(digits(value)).expect("F0");
        let par = read(out.path(), &format!("{}.par", built_in.name));
        let fitted = par.lines().find_map(|line| line.strip_prefix("F0 ")).expect("F0").trim();
        let relative = fitted.parse::<f64>().expect("a number") / published - 1.0;
        assert!(relative.abs() < 1e-11, "{}: {fitted} and {published}", built_in.name);
    }
}

/// The lines of the .tim and the .par say what the table says, to the last digit of each.
#[test]
fn files_agree_with_the_table() {
    let out = folder();
    for fit in [&["b1828-11", "--every", "20"][..], &["b1828-11", "--every", "20", "--f1", "--force"]] {
        written(fit, out.path());
        let (csv, par, tim) =
            (read(out.path(), "b1828-11.csv"), read(out.path(), "b1828-11.par"), read(out.path(), "b1828-11.tim"));
        let value = |key: &str| par.lines().find_map(|line| line.strip_prefix(&format!("{key} "))).map(str::trim);
        assert_eq!([value("PSR"), value("UNITS"), value("TRACK")], [Some("B1828-11"), Some("TDB"), Some("-2")]);
        assert_eq!(
            [value("RAJ"), value("DECJ"), value("TZRSITE")],
            [Some("18:30:47.567"), Some("-10:59:27.92"), Some("@")]
        );
        assert_eq!(value("F1").is_some(), fit.contains(&"--f1"));
        let date = |key: &str| value(key).and_then(|text| text.parse::<Epoch>().ok()).expect("a date");
        let mut lines = tim.lines();
        assert_eq!(lines.next(), Some("FORMAT 1"));
        let points: Vec<_> = lines
            .map(|line| {
                let fields: Vec<_> = line.split_whitespace().collect();
                let [_, "0.0", date, "1", "@", "-pn", number] = fields[..] else { panic!("{line}") };
                (number.parse::<i64>().expect("a number"), date.parse::<Epoch>().expect("a date"))
            })
            .collect();
        let rows = rows(&csv);
        assert_eq!(points.len(), rows.len());
        let shift = points[0].0 - rows[0][0] as i64;
        for ((number, arrival), row) in points.iter().zip(&rows) {
            assert_eq!((number - shift, arrival.day()), (row[0] as i64, row[1] as i64));
            assert!((arrival.fraction() - row[2]).abs() <= 1e-17);
        }
        // The reference of the numbers, and the residuals, by the digits of the .par alone.
        let times: Vec<_> = points.iter().map(|(n, at)| (*n, at.seconds_since(&date("PEPOCH")))).collect();
        let fit = SpinFit::new(&times, value("F1").is_some()).expect("a fit");
        for (ours, row) in fit.residuals.iter().zip(&rows) {
            assert!((ours - row[3]).abs() < 2e-11, "{ours:e} {row:?}");
        }
        let [off, _] = date("TZRMJD").seconds_since(&date("PEPOCH"));
        assert!((off - fit.time_of(0)[0]).abs() < 1e-9 && off.abs() < 1.0, "{off}");
    }
}

/// What a timing program makes of the .par and the .tim: the phase at each arrival by all digits of F0 and F1, counted from TZRMJD. 3e11 turns to 3e-11 s are
/// 22 digits; dates are rounded to 1e-16 d, 8.6e-12 s, at the arrival and at TZRMJD.
#[test]
fn the_digits_of_the_files_give_the_residuals() {
    let out = folder();
    for (scene, extra) in [("b1937+21", None), ("b1937+21", Some("--f1")), ("b1828-11", Some("--f1"))] {
        written(&[&[scene, "--epochs", "40", "--force"][..], extra.as_slice()].concat(), out.path());
        let [csv, par, tim] = ["csv", "par", "tim"].map(|ending| read(out.path(), &format!("{scene}.{ending}")));
        let value = |key: &str| par.lines().find_map(|line| line.strip_prefix(&format!("{key} "))).map(str::trim);
        let number = |text: &str| text.parse::<DoubleDouble>().expect("a number");
        let epoch: Epoch = value("PEPOCH").expect("PEPOCH").parse().expect("a date");
        let since = |text: &str| {
            let [high, low] = text.parse::<Epoch>().expect("a date").seconds_since(&epoch);
            DoubleDouble::sum_of(high, low)
        };
        let (f0, f1) = (number(value("F0").expect("F0")), number(value("F1").unwrap_or("0")));
        assert_eq!(value("F1").is_some(), extra.is_some());
        let phase = |t: DoubleDouble| f0 * t + f1 * t * t * number("0.5");
        let zero = phase(since(value("TZRMJD").expect("TZRMJD")));
        for (line, row) in tim.lines().skip(1).zip(rows(&csv)) {
            let fields: Vec<_> = line.split_whitespace().collect();
            let late = (phase(since(fields[2])) - zero - number(fields[6])) / f0;
            assert!((late.high() - row[3]).abs() < 3e-11, "{scene}: {:e}, in the table {:e}", late.high(), row[3]);
        }
    }
}

/// A fitted spin-down absorbs the residuals that a slow drift of L makes in a year, but not those of a wobble.
#[test]
fn a_wobble_is_not_absorbed_by_a_spin_down() {
    let scene = Scene::named("b1828-11").expect("a scene");
    let epochs = |pulsar: &PulsarScene| {
        (0..400).map(|k| pulsar.epoch.after([f64::from(k) * 7.9e5, 0.0]).expect("near")).collect::<Vec<_>>()
    };
    let rms = |scene: &Scene, with_rate| {
        let mut pulsar = PulsarScene::new(scene).expect("a pulsar");
        let epochs = epochs(&pulsar);
        pulsar.timed(&epochs, with_rate).expect("times").root_mean_square()
    };
    let (period, theta, chi) = (1.0 / 2.468_871_714_7, 3f64.to_radians(), 89f64.to_radians());
    // First and second order of theta: theta cot chi sin gamma and (theta^2 / 4) sin 2 gamma.
    let expected = period / std::f64::consts::TAU * ((theta / chi.tan()).hypot(theta * theta / 4.0) / 2f64.sqrt());
    for with_rate in [false, true] {
        let found = rms(&scene, with_rate);
        assert!((found / expected - 1.0).abs() < 0.05, "{found:e} for {expected:e}");
    }
    // |s| of 1e-9 turns L of a millisecond pulsar in decades: a drift of the pulses that a spin-down hides for a year.
    let stronger = PULSARS[1].toml.replace("alpha_2 = 1.6e-9", "alpha_2 = 6.6e-4");
    let scene = Scene::from_toml("stronger", &stronger).expect("a scene");
    let mut pulsar = PulsarScene::new(&scene).expect("a pulsar");
    let year: Vec<_> = (0..200).map(|k| pulsar.epoch.after([f64::from(k) * 7.9e4, 0.0]).expect("near")).collect();
    let [without, with] = [false, true].map(|with| pulsar.timed(&year, with).expect("times").root_mean_square());
    assert!(without > 1e-10 && with < 0.01 * without, "{without:e} {with:e}");
}

#[test]
fn dark_epochs_are_left_out_with_a_note() {
    let out = folder();
    let text = PULSARS[0].toml.replace("alpha_2 = 1.6e-9", "alpha_2 = 6.6e-4");
    let path = out.path().join("strong.toml");
    fs::write(&path, text).expect("file");
    let results = out.path().join("results");
    let args =
        ["timing", path.to_str().expect("path"), "--from", "50000", "--to", "60000.5", "--epochs", "300", "--out"];
    let output = succeeds(&[&args[..], &[results.to_str().expect("path")]].concat());
    assert!(stderr(&output).contains("of 300 epochs have no pulse"), "{}", stderr(&output));
    let count = rows(&read(&results, "strong.csv")).len();
    assert!((3..300).contains(&count), "{count}");
    assert!(stdout(&output).contains(&format!("{count} arrival times")));
}

#[test]
fn what_cannot_be_timed_is_refused_and_nothing_is_written() {
    let out = folder();
    let results = out.path().join("results");
    let scene = |name: &str, from: &str, to: &str| {
        let path = out.path().join(format!("{name}.toml"));
        assert!(PULSARS[2].toml.contains(from), "{from}");
        fs::write(&path, PULSARS[2].toml.replacen(from, to, 1)).expect("file");
        path.to_str().expect("path").to_owned()
    };
    let no_epoch = scene("no-epoch", "epoch = \"49621.0\"\n", "");
    let bad_epoch = scene("bad-epoch", "\"49621.0\"", "\"4 January\"");
    let years_and_span = scene("years-and-span", "years = 10.0", "years = 10.0\nspan = 5.0");
    let no_years = scene("no-years", "years = 10.0", "years = 0.0");
    let position = scene("position", "-10:59:27.92", "-10:59");
    let half_position = scene("half-position", "declination = \"-10:59:27.92\"\n", "");
    let name = scene("name", "\"B1828-11\"", "\"B 1828\"");
    let source = scene("source", "sources = [\n", "sources = [\n    5,\n");
    let fast = scene("fast", "alpha_2 = 1.6e-9", "alpha_2 = 1.6e-9\nw_unit = 3");
    for (args, fragments) in [
        (&["tp-1"][..], &["tp-1: the scene is in the paper's units", "star.mass"][..]),
        (&[no_epoch.as_str()], &["the scene lacks `time.epoch`"]),
        (&[&bad_epoch], &["`time.epoch` = \"4 January\"", "modified Julian date from 0 to 1e7"]),
        (&[&years_and_span], &["`time.years` beside `time.span`", "only one of the two"]),
        (&[&no_years], &["`time.years` = 0.0", "not zero"]),
        (&[&position], &["`pulsar.declination` = \"-10:59\"", "degrees, minutes and seconds"]),
        (&[&half_position], &["missing `pulsar.declination`"]),
        (&[&name], &["`pulsar.name` = \"B 1828\"", "a name without spaces"]),
        (&[&source], &["`sources[0]` = 5", "a string in quotes"]),
        (&[&fast], &["unknown key `lorentz_violation.w_unit`"]),
        (
            &["b1828-11", "--from", "yesterday"],
            &["'yesterday' for '--from <MJD>'", "a modified Julian date from 0 to 1e7"],
        ),
        (
            &["b1828-11", "--from", "50000", "--to", "50000"],
            &["epochs from 50000.0 to 50000.0", "later date", "--from, --to"],
        ),
        (&["b1828-11", "--every", "0"], &["--every 0: allowed is a number above zero"]),
        (&["b1828-11", "--every", "1e-9"], &["allowed are from 2 to 10000000"]),
        (&["b1828-11", "--epochs", "1"], &["1 epochs are asked for"]),
        (&["b1828-11", "--every", "5", "--epochs", "7"], &["cannot be used with"]),
        (&["b1828-11", "--uncertainty", "-1"], &["--uncertainty -1: allowed is a number above zero"]),
        (&["b1828-11", "--strain-rate", "nan"], &["--strain-rate NaN"]),
        (&["b1828-11", "--strain-span", "1e9"], &["samples of strain", "from 2 to 10000000"]),
        (&["nonesuch"], &["neither a built-in scene"]),
    ] {
        let output = twofold(&[&["timing"], args, &["--out", results.to_str().expect("path")]].concat());
        let message = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{args:?}: {message}");
        assert!(fragments.iter().all(|fragment| message.contains(fragment)), "{args:?}: {message}");
        assert!(!results.exists(), "{args:?}");
    }
}

/// A beam that never passes, one that is always seen, and a star at rest: each has its own sentence, with the closest approach and what to
/// change.
#[test]
fn a_scene_without_pulses_is_told_why() {
    let out = folder();
    let results = out.path().join("results");
    let replaced = |line: &str, by: &str, text: &str| -> String {
        text.lines()
            .map(|found| if found.starts_with(line) { by } else { found })
            .fold(String::new(), |all, l| all + l + "\n")
    };
    let fast = PULSARS[0].toml;
    // Of the magnetic axis, 75 degrees from the spin, to the observer, 80 degrees from it: 5 and 155 degrees.
    for (name, text, fragments) in [
        (
            "never",
            replaced("rho = ", "rho = 0.05", fast),
            &[
                "never passes the line of sight",
                "comes to 0.087266 rad of it at closest",
                "`pulsar.rho` is 0.05 rad",
                "above",
            ][..],
        ),
        (
            "always",
            replaced("rho = ", "rho = 3.0", fast),
            &[
                "always inside the beam",
                "2.7052",
                "rad from it at most (0.087266 rad at closest)",
                "`pulsar.rho` is 3 rad",
                "below",
            ],
        ),
        (
            "still",
            replaced("spin_frequency = ", "spin_frequency = 0.0", fast),
            &["the star does not rotate", "`star.spin_frequency` other than zero"],
        ),
    ] {
        let path = out.path().join(format!("{name}.toml"));
        fs::write(&path, text).expect("file");
        let path = path.to_str().expect("path");
        let output = twofold(&["timing", path, "--out", results.to_str().expect("path")]);
        let message = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{name}: {message}");
        has_all(&message, &[&[path][..], fragments].concat());
        assert!(!results.exists() || names_in(&results).is_empty(), "{name}");
    }
}

/// The frequency that a scene states, to the rounding of the initial momentum: arrival times are wrong by as much, linearly in time, and
/// residuals are not.
#[test]
fn the_stated_error_holds_the_rounding_of_the_start() {
    let out = folder();
    let mut worst: f64 = 0.0;
    for frequency in ["641.9282333345536", "641.9", "100.3", "57.123456789", "2.468871714699942", "-3.7"] {
        let text: String = PULSARS[0]
            .toml
            .lines()
            .map(|line| match line {
                line if line.starts_with("spin_frequency") => format!("spin_frequency = {frequency}\n"),
                line if line.starts_with("alpha_2") => "alpha_2 = 0.0\n".to_owned(),
                line => format!("{line}\n"),
            })
            .collect();
        let path = out.path().join("free.toml");
        fs::write(&path, text).expect("file");
        let results = out.path().join("results");
        let (path, results_at) = (path.to_str().expect("path"), results.to_str().expect("path"));
        let args = ["timing", path, "--to", "62626", "--epochs", "100", "--force", "--out", results_at];
        let output = twofold(&args);
        let (notes, summary) = (stderr(&output), stdout(&output));
        assert_eq!(output.status.code(), Some(0), "{notes}");
        let number = |text: &str, after: &str| -> f64 {
            let rest = text.split_once(after).unwrap_or_else(|| panic!("{after} in {text}")).1.trim_start();
            rest.split([' ', ';']).next().and_then(|word| word.parse().ok()).unwrap_or_else(|| panic!("{rest}"))
        };
        // One number in the summary and in the .par.
        let par = read(&results, "free.par");
        let in_par = par.lines().find_map(|line| line.strip_prefix("F0 ")).expect("F0").trim();
        assert!(summary.contains(&format!("F0 = {in_par} Hz")), "{summary}{in_par}");
        // In units of 1e-24 Hz.
        let exact = |text: &str| -> i128 {
            let (whole, fraction) = text.trim_start_matches('-').split_once('.').expect("a point");
            format!("{whole}{fraction:0<24}").parse().expect("digits")
        };
        let off = (exact(in_par) - exact(frequency)) as f64 * 1e-24 / exact(frequency) as f64 * 1e24;
        // 20 years.
        let late = off.abs() * 7305.0 * 86_400.0;
        let stated = number(&notes, "estimated error of the arrival times themselves:");
        assert!(late <= stated && stated < 1e-6, "{frequency}: {late:e} s for {stated:e} s");
        let of_residuals = number(&notes, "estimated error of the residuals:");
        assert!(number(&summary, "largest ") <= of_residuals && of_residuals < 1e-11, "{summary}{notes}");
        worst = worst.max(late);
    }
    // The rounding is there, a thousand times what residuals have.
    assert!(worst > 1e-8, "{worst:e} s");
}

/// Of epochs before that of the scene the first is the farthest.
#[test]
fn the_errors_that_are_printed_are_those_at_the_farthest_epoch() {
    let out = folder();
    let out = out.path().to_str().expect("path in UTF-8");
    let output = twofold(&["timing", "b1828-11", "--from", "42000", "--to", "49000", "--epochs", "3", "--out", out]);
    let notes = stderr(&output);
    let pulsar = PulsarScene::new(&Scene::named("b1828-11").expect("a scene")).expect("a pulsar");
    // The epoch of the scene is MJD 49621.
    let farthest = (49_621.0 - 42_000.0) * 86_400.0;
    for (what, error) in
        [("residuals", pulsar.residual_error(farthest)), ("arrival times themselves", pulsar.arrival_error(farthest))]
    {
        let printed = format!("note: estimated error of the {what}: {error:.1e} s");
        assert!(notes.contains(&printed), "expected `{printed}` in\n{notes}");
    }
}

#[test]
fn files_are_not_replaced_without_leave() {
    let out = folder();
    written(&["b1642-03", "--epochs", "5"], out.path());
    let before = read(out.path(), "b1642-03.csv");
    let again = refuses(&["timing", "b1642-03", "--epochs", "6", "--out", out.path().to_str().expect("path")]);
    has_all(&stderr(&again), &["b1642-03.csv and 4 more exist there; --force replaces them"]);
    assert_eq!(read(out.path(), "b1642-03.csv"), before);
    written(&["b1642-03", "--epochs", "6", "--force"], out.path());
    assert_eq!(rows(&read(out.path(), "b1642-03.csv")).len(), 6);
}

#[test]
fn other_commands_take_a_pulsar_or_say_why_not() {
    let spectrum = succeeds(&["spectrum", "b1828-11", "--of", "h_plus", "--span", "200", "--unidentified"]);
    // Twice the rate of the symmetry axis about L, then that rate: 2 pi F0 and the wobble's share.
    let frequency =
        |line: usize| stdout(&spectrum).lines().nth(line).and_then(|line| line.split(',').next()?.parse::<f64>().ok());
    let [twice, once] = [frequency(1), frequency(2)].map(|f| f.expect("a line"));
    assert!(
        (twice / once - 2.0).abs() < 1e-10 && (once / std::f64::consts::TAU - 2.468_871_7).abs() < 1e-6,
        "{twice} {once}"
    );
    let explained = twofold(&["run", "b1937+21", "--explain"]);
    assert!(stdout(&explained).contains("averaged motion to second order"), "{}", stdout(&explained));
    let pulses = refuses(&["pulses", "b1937+21"]);
    assert!(stderr(&pulses).contains("`twofold timing` computes the pulses near given epochs"), "{}", stderr(&pulses));
}

/// Pulses asked for one by one have the numbers of all those between.
#[test]
fn numbers_have_no_break() {
    let out = folder();
    written(&["b1828-11", "--from", "50000", "--to", "50000.0001", "--epochs", "40"], out.path());
    let near = rows(&read(out.path(), "b1828-11.csv"));
    written(&["b1828-11", "--from", "49000", "--to", "50000.0001", "--every", "333.3", "--force"], out.path());
    let far = rows(&read(out.path(), "b1828-11.csv"));
    let (first, last) = (&near[0], &far[far.len() - 1]);
    let days = (last[1] - first[1]) + (last[2] - first[2]);
    let turns = (last[0] - first[0]) - days * 86_400.0 * 2.468_871_714_7;
    assert!(turns.abs() < 1e-3, "{turns}");
}

/// A span of a million years, as it is allowed, has arrival times; one beyond all dates is refused at its place.
#[test]
fn a_span_in_years_is_as_long_as_is_allowed() {
    let folder = folder();
    let built_in = include_str!("../../../scene/scenes/b1642-03.toml");
    let years = built_in.lines().find(|line| line.starts_with("years")).expect("years");
    let samples = built_in.lines().find(|line| line.starts_with("samples")).expect("samples");
    let line = 1 + built_in.lines().position(|line| line == "[time]").expect("the section");
    for (span, status) in [("years = 1e6", 0), ("years = -1e6", 0), ("span = 1e300", 2)] {
        let scene = folder.path().join("long.toml");
        fs::write(&scene, built_in.replace(years, span).replace(samples, "samples = 9")).expect("scene");
        let out = folder.path().join("out");
        let output =
            twofold(&["timing", scene.to_str().expect("UTF-8"), "--force", "--out", out.to_str().expect("UTF-8")]);
        let message = stderr(&output);
        assert_eq!(output.status.code(), Some(status), "{span}: {message}");
        assert_eq!(message.contains(&format!("long.toml:{line}:1: [time] ends ")), status == 2, "{span}: {message}");
        let arrivals = fs::read_to_string(out.join("long.tim")).expect("arrival times");
        assert_eq!(arrivals.lines().filter(|line| line.contains("-pn")).count(), 9, "{span}: {arrivals}");
    }
}

/// Directions that are off by an angle make the pulses of a slow star late by that part of a turn.
#[test]
fn the_rounding_of_directions_is_a_part_of_a_turn() {
    let frequency = 1e-6;
    let line = |line: &str| match line {
        line if line.starts_with("spin_frequency") => format!("spin_frequency = {frequency:?}\n"),
        line if line.starts_with("alpha_rate") => {
            format!("alpha_rate = {:?}\n", std::f64::consts::TAU * frequency / 0.052_359_877_559_829_89_f64.cos())
        }
        line if line.starts_with("alpha_2") => "alpha_2 = 0.0\n".to_owned(),
        line => format!("{line}\n"),
    };
    let toml = PULSARS.iter().find(|pulsar| pulsar.name == "b1828-11").expect("a scene").toml;
    let scene = Scene::from_toml("slow", &toml.lines().map(line).collect::<String>()).expect("a scene");
    let pulsar = PulsarScene::new(&scene).expect("a pulsar");
    // Without s and at the start nothing else is left; a turn takes 1e6 s but for the 1e-3 by which the axis goes round faster.
    let turns = pulsar.clock.mean_motion().rounding(0.0) / std::f64::consts::TAU;
    let error = pulsar.residual_error(0.0);
    assert!(turns / frequency > 1e-10, "{turns}");
    assert!((error * frequency / turns - 1.0).abs() < 2e-3, "{error:e} s for {turns:e} turns");
}
