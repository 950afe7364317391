//! The command `twofold timing` as a user sees it: files, numbers in them, refusals.

use crate::common::{
    Folder, altered, cells, ends, has_all, names_in, number_after, numbers, stderr, stdout, succeeds, with_lines,
};
use std::f64::consts::TAU;
use twofold::epoch::Epoch;
use twofold::observables::pulsar::SpinFit;
use twofold_scene::pulsar_timing::PulsarScene;
use twofold_scene::scene_file::{PULSARS, Scene, TEMPLATES};
use twofold_scene::trajectory;
use twofold_verify::double_double::DoubleDouble;

/// The value of a key in a .par.
fn value<'p>(par: &'p str, key: &str) -> Option<&'p str> {
    par.lines().find_map(|line| line.strip_prefix(&format!("{key} "))).map(str::trim)
}

/// Each template runs unchanged; those with a beam have a pulse at every epoch, and a fit of their own data starts at its end.
#[test]
fn every_template_does_what_it_is_for() {
    for template in TEMPLATES {
        let name = template.name;
        let scene = Scene::named(name).unwrap_or_else(|error| panic!("{error}"));
        assert!(scene.about.starts_with("template: ") && scene.about.len() < 100, "{name}");
        let folder = Folder::new();
        let table = stdout(&folder.succeeds(&["run", name]));
        assert!(table.lines().count() > scene.times.count(), "{name}");
        if scene.pulsar.is_some() {
            folder.succeeds(&["timing", name, "--epochs", "50", "--out", "."]);
            assert_eq!(numbers(&folder.read(&format!("{name}.csv"))).len(), 50, "{name}: the pulse is always seen");
            let tim = format!("{name}.tim");
            let fitted = folder.succeeds(&["limits", name, &tim, "--parameters", "phase,f0,f1,f2"]);
            let told = stderr(&fitted);
            assert!(number_after(&told, "chi^2 = ") < 1e-3, "{name}: {told}");
        }
    }
}

#[test]
fn every_built_in_pulsar_is_timed_and_runs() {
    for built_in in PULSARS {
        let scene = Scene::named(built_in.name).unwrap_or_else(|error| panic!("{error}"));
        assert!(!scene.about.is_empty() && scene.about.len() < 100 && scene.sources.len() >= 3, "{}", built_in.name);
        let summary = trajectory::write_csv(&scene, std::io::sink(), |_| Ok(())).expect(built_in.name);
        assert_eq!(summary.rows, 1000, "{}", built_in.name);
        let folder = Folder::new();
        folder.succeeds(&["timing", built_in.name, "--epochs", "50", "--out", "."]);
        let endings = ["csv", "h_cross.txt", "h_plus.txt", "par", "png", "svg", "tim"];
        assert_eq!(folder.names(), endings.map(|ending| format!("{}.{ending}", built_in.name)));
        assert_eq!(
            numbers(&folder.read(&format!("{}.csv", built_in.name))).len(),
            50,
            "{}: the pulse is always seen",
            built_in.name
        );
        // The pulse frequency is the published one.
        let is_frequency = |line: &&str| line.starts_with("spin_frequency") || line.starts_with("frequency");
        let published = built_in.toml.lines().find(is_frequency).expect("a frequency");
        let digits = |text: &str| {
            text.split(|c: char| !c.is_ascii_digit() && c != '.').find_map(|part| part.parse::<f64>().ok())
        };
        let (digits_of_value, comment) =
            published.split_once('=').and_then(|(_, rest)| rest.split_once('#')).expect("a comment");
        let published =
            comment.split_once("F0 = ").and_then(|(_, rest)| digits(rest)).or(digits(digits_of_value)).expect("F0");
        let par = folder.read(&format!("{}.par", built_in.name));
        let number = |key: &str| value(&par, key).map(|text| text.parse::<f64>().expect("a number"));
        // At the epoch of the scene. A varying torque changes the frequency by a relative 2e-9 within a precession, and the fit by a fraction
        // of that.
        let epoch: Epoch = value(&par, "PEPOCH").expect("PEPOCH").parse().expect("a date");
        let [since, _] = scene.epoch.expect("an epoch").seconds_since(&epoch);
        let changed = since * (number("F1").unwrap_or(0.0) + since / 2.0 * number("F2").unwrap_or(0.0));
        let relative = (number("F0").expect("F0") + changed) / published - 1.0;
        let allowed = if scene.spin_down.is_some() { 1e-9 } else { 1e-11 };
        assert!(relative.abs() < allowed, "{}: {relative:e}", built_in.name);
    }
}

/// The lines of the .tim and the .par agree with the table to the last digit of each.
#[test]
fn files_agree_with_the_table() {
    let folder = Folder::new();
    for fit in [&["--every", "20"][..], &["--every", "20", "--f1", "--force"]] {
        folder.succeeds(&[&["timing", "b1828-11", "--out", "."], fit].concat());
        let [csv, par, tim] = ["csv", "par", "tim"].map(|ending| folder.read(&format!("b1828-11.{ending}")));
        let value = |key: &str| value(&par, key);
        assert_eq!([value("PSR"), value("UNITS"), value("TRACK")], [Some("B1828-11"), Some("TDB"), Some("-2")]);
        assert_eq!(
            [value("RAJ"), value("DECJ"), value("TZRSITE")],
            [Some("18:30:47.567"), Some("-10:59:27.92"), Some("@")]
        );
        assert_eq!([value("F1"), value("F2")].map(|of| of.is_some()), [true, !fit.contains(&"--f1")]);
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
        let rows = numbers(&csv);
        assert_eq!(points.len(), rows.len());
        let shift = points[0].0 - rows[0][0] as i64;
        for ((number, arrival), row) in points.iter().zip(&rows) {
            assert_eq!((number - shift, arrival.day()), (row[0] as i64, row[1] as i64));
            assert!((arrival.fraction() - row[2]).abs() <= 1e-17);
        }
        // The zero of the numbers and the residuals follow from the digits of the .par alone.
        let times: Vec<_> = points.iter().map(|(n, at)| (*n, at.seconds_since(&date("PEPOCH")))).collect();
        let fit = SpinFit::new(&times, ["F1", "F2"].iter().filter(|key| value(key).is_some()).count()).expect("a fit");
        for (ours, row) in fit.residuals.iter().zip(&rows) {
            assert!((ours - row[3]).abs() < 2e-11, "{ours:e} {row:?}");
        }
        let [off, _] = date("TZRMJD").seconds_since(&date("PEPOCH"));
        assert!((off - fit.time_of(0)[0]).abs() < 1e-9 && off.abs() < 1.0, "{off}");
    }
}

/// A timing program's reading of the .par and the .tim: the phase at each arrival from all digits of F0, F1 and F2, counted from TZRMJD. 3e11 turns
/// to 3e-11 s are 22 digits; dates are rounded to 1e-16 d, 8.6e-12 s, at the arrival and at TZRMJD.
#[test]
fn the_digits_of_the_files_give_the_residuals() {
    let folder = Folder::new();
    for (scene, extra) in
        [("b1937+21", None), ("b1937+21", Some("--f1")), ("b1828-11", Some("--f1")), ("b1828-11", Some("--f2"))]
    {
        let args = ["timing", scene, "--epochs", "40", "--force", "--out", "."];
        folder.succeeds(&[&args[..], extra.as_slice()].concat());
        let [csv, par, tim] = ["csv", "par", "tim"].map(|ending| folder.read(&format!("{scene}.{ending}")));
        let value = |key: &str| value(&par, key);
        let number = |text: &str| text.parse::<DoubleDouble>().expect("a number");
        let epoch: Epoch = value("PEPOCH").expect("PEPOCH").parse().expect("a date");
        let since = |text: &str| {
            let [high, low] = text.parse::<Epoch>().expect("a date").seconds_since(&epoch);
            DoubleDouble::sum_of(high, low)
        };
        let [f0, f1, f2] = ["F0", "F1", "F2"].map(|key| number(value(key).unwrap_or("0")));
        assert_eq!([value("F1"), value("F2")].map(|given| given.is_some()), [extra.is_some(), extra == Some("--f2")]);
        let half = number("0.5");
        let phase = |t: DoubleDouble| t * (f0 + t * (f1 * half + t * f2 / number("6")));
        let zero = phase(since(value("TZRMJD").expect("TZRMJD")));
        for (line, row) in tim.lines().skip(1).zip(numbers(&csv)) {
            let fields: Vec<_> = line.split_whitespace().collect();
            let at = since(fields[2]);
            let late = (phase(at) - zero - number(fields[6])) / (f0 + at * (f1 + at * f2 * half));
            assert!((late.high() - row[3]).abs() < 3e-11, "{scene}: {:e}, in the table {:e}", late.high(), row[3]);
        }
    }
}

/// A fitted spin-down absorbs the residuals of a slow drift of L over a year, but not those of a wobble.
#[test]
fn a_wobble_is_not_absorbed_by_a_spin_down() {
    let scene = Scene { spin_down: None, ..Scene::named("b1828-11").expect("a scene") };
    let rms = |scene: &Scene, (count, step): (u32, f64), derivatives| {
        let pulsar = PulsarScene::new(scene).expect("a pulsar");
        let epochs = (0..count).map(|k| pulsar.epoch.after([f64::from(k) * step, 0.0]).expect("near"));
        pulsar.timed(&epochs.collect::<Vec<_>>(), derivatives).expect("times").root_mean_square()
    };
    let (period, theta, chi) = (1.0 / 2.468_871_714_7, 3f64.to_radians(), 89f64.to_radians());
    // First and second order in theta: theta cot chi sin gamma and (theta^2 / 4) sin 2 gamma.
    let expected = period / std::f64::consts::TAU * ((theta / chi.tan()).hypot(theta * theta / 4.0) / 2f64.sqrt());
    for derivatives in [0, 1] {
        let found = rms(&scene, (400, 7.9e5), derivatives);
        assert!((found / expected - 1.0).abs() < 0.05, "{found:e} for {expected:e}");
    }
    // |s| = 1e-12 turns L of a millisecond pulsar by 0.014 rad in half a year: a drift of the pulses that a spin-down absorbs.
    let stronger = PULSARS[0].toml.replace("alpha_2 = 1.6e-9", "alpha_2 = 6.6e-7");
    let scene = Scene::from_toml("stronger", &stronger).expect("a scene");
    let [without, with] = [0, 1].map(|derivatives| rms(&scene, (200, 7.9e4), derivatives));
    assert!(without > 1e-10 && with < 0.01 * without, "{without:e} {with:e}");
}

/// The causes add up to the residuals, except for the secular spin-down. For B1828-11, with a wobble of 3 degrees and a magnetic axis at 89 degrees
/// to the axis, the delay by a dipole torque is `F1 g / (F0 w^2)` times `a_1 = -sin 2 theta sin 2 chi / 2` and
/// `a_2 / 4 = -sin^2 theta sin^2 chi / 8`, and half of that if half of the torque does not depend on the axis.
#[test]
fn the_causes_of_residuals_add_up() {
    let amplitudes = |torque: &str| {
        let folder = Folder::with(&[("star.toml", &with_lines("b1828-11", &[("torque", torque)]))]);
        folder.succeeds(&["timing", "star.toml", "--causes", "--out", "."]);
        let table = folder.read("star.csv");
        let named: Vec<_> = cells(&table)[0][16..].iter().map(|name| name.split(' ').next().expect("a name")).collect();
        assert_eq!(named, ["geometry", "torque", "violation", "spin_down_rate"]);
        let rows = numbers(&table);
        assert_eq!(rows.len(), 1000);
        let days = |row: &[f64]| row[1] - 49_621.0 + row[2];
        for row in &rows {
            let [residual, geometry, torque, violation] = [row[3], row[16], row[17], row[18]];
            // A fit of a cubic to a quartic leaves the fourth Legendre polynomial: F3 = n (2 n - 1) F1^3 / F0^2, n = 3, over ten years; to a
            // hundredth for a thousand points.
            let half = 1826.25;
            let x = days(row) / half - 1.0;
            let f3 = 15.0 * 3.6568e-13_f64.powi(3) / 2.468_871_714_7_f64.powi(2);
            let size = f3 / 24.0 * (half * 86_400.0).powi(4) * 8.0 / 35.0 / 2.468_871_714_7;
            let secular = size * (35.0 * x.powi(4) - 30.0 * x * x + 3.0) / 8.0;
            assert!((residual - geometry - torque - violation - secular).abs() < 1e-2 * size, "{secular:e} {row:?}");
            assert!(geometry.abs() < 1e-4 && violation.abs() < 1e-11);
            assert!((row[19] / -3.6568e-13 - 1.0).abs() < 4e-3, "{row:?}");
        }
        // 3,652.5 d are 7.3 precessions; the fitted polynomial absorbs a few percent of seven.
        let whole: Vec<_> = rows.iter().filter(|row| days(row) < 3500.0).collect();
        [500.0, 250.0].map(|period| {
            let sums = whole.iter().fold([0.0; 2], |[c, s], row| {
                let (sin, cos) = (std::f64::consts::TAU * days(row) / period).sin_cos();
                [c + row[17] * cos, s + row[17] * sin]
            });
            2.0 * sums[0].hypot(sums[1]) / whole.len() as f64
        })
    };
    let (theta, chi, w) = (3f64.to_radians(), 89f64.to_radians(), std::f64::consts::TAU / (500.0 * 86_400.0));
    let scale = 3.6568e-13 / 2.468_871_714_7 / (w * w);
    let expected =
        [scale * (2.0 * theta).sin() * (2.0 * chi).sin() / 2.0, scale * (theta.sin() * chi.sin()).powi(2) / 8.0];
    for (torque, share) in [("torque = \"vacuum\"", 1.0), ("torque = \"plasma\"", 0.5)] {
        for (found, expected) in amplitudes(torque).into_iter().zip(expected) {
            assert!((found / expected / share - 1.0).abs() < 0.05, "{torque}: {found:e} {expected:e}");
        }
    }
}

/// Commands other than `timing` use the rotation at the epoch, and say so.
#[test]
fn spin_down_is_for_timing() {
    let folder = Folder::new();
    let notes = stderr(&folder.succeeds(&["run", "b1828-11", "--out", "run.csv"]));
    has_all(
        &notes,
        &["[spin_down] is for `twofold timing`; here the star keeps the rotation rate that it has at the epoch"
            .to_owned()],
    );
    let rare = folder.succeeds(&["timing", "b1828-11", "--every", "300", "--out", "."]);
    has_all(
        &stderr(&rare),
        &["5.000000e2 d", "more than half of the precession period of the body"].map(str::to_owned),
    );
    assert!(!stderr(&rare).contains("[spin_down]"));
    // The limit is a tenth of the rotation.
    let late = folder.run(&["timing", "b1828-11", "--to", "9000000", "--epochs", "9", "--force", "--out", "."]);
    has_all(&stderr(&ends(late, 1)), &["F1 t / F0".to_owned()]);
}

/// With `damping_time` the tangent of the wobble falls by a factor e in that number of days, and the effect of Lorentz violation on the arrival times
/// stays as small as without friction.
#[test]
fn friction_takes_the_wobble_away() {
    let star = |lines: &str| {
        let built_in = twofold_scene::scene_file::built_in("b1828-11").expect("a scene").toml;
        built_in.replace("torque = \"vacuum\"", &format!("torque = \"vacuum\"\n{lines}\n#"))
    };
    let scene = Scene::from_toml("damped", &star("damping_time = 2000.0")).expect("a scene");
    let pulsar = PulsarScene::new(&scene).expect("a pulsar");
    let epochs: Vec<_> = (0..40).map(|k| pulsar.epoch.after([f64::from(k) * 7.9e6, 0.0]).expect("near")).collect();
    let timing = pulsar.timed(&epochs, 2).expect("times");
    for timed in &timing.pulses {
        let (state, days) = (&timed.pulse.state, timed.pulse.midpoint[0] / 86_400.0);
        let expected = 3f64.to_radians().tan() * (-days / 2000.0).exp();
        let found = state.axis.angle(&state.momentum).tan();
        assert!((found / expected - 1.0).abs() < 1e-4, "{days}: {found} for {expected}");
    }
    let causes = pulsar.causes(&timing).expect("causes");
    let largest = |of: &[f64]| of.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    let [torque, violation] = [&causes.torque, &causes.violation].map(|of| largest(of));
    assert!(violation < 1e-9 && torque > 1e-3, "{torque:e} {violation:e}");

    for (lines, said) in [
        ("damping_time = 0.0", "from 1e-3 to 1e12 [d]"),
        ("damping_time = 2000.0\nindex = 2.5", "`damping_time` is only for a braking index of 3"),
        ("damping_time = 700.0", "rate of damping over that of the precession"),
        ("damping_time = 1000.0", "at most 2 in size"),
    ] {
        let folder = Folder::new();
        folder.write("star.toml", star(lines));
        let failed = folder.run(&["timing", "star.toml", "--out", "."]);
        assert!(stderr(&failed).contains(said), "{lines}: {}", stderr(&failed));
    }
}

/// With a strong bulge the columns of rates are the slopes of the neighbouring columns, and the energy contains that of the bulge.
#[test]
fn rates_have_the_turning_of_the_bulge() {
    let lines = [
        ("alpha_2", "eigenvalues = [0.2, 0.05, -0.2]"),
        ("w = ", ""),
        ("[spin_down]", ""),
        ("f1", ""),
        ("torque", ""),
        ("wobble", "wobble = 0.7\nmomentum = [0.3, 0.5, 0.8]"),
        // The rigid deformation is so weak that the averaged motion neglects 1e-7.
        ("precession_period", "precession_period = 4e6"),
        ("epoch", "span = 0.1"),
        ("years", ""),
        ("samples", "samples = 2001"),
    ];
    let rigid = [&lines[..], &[("bulge", "")]].concat();
    let folder = Folder::with(&[
        ("star.toml", &with_lines("b1828-11", &lines)),
        ("rigid.toml", &with_lines("b1828-11", &rigid)),
    ]);
    let columns = "angles,rates,lambda,m.n,position_angle,integrals";
    let [text, of_rigid] = ["star", "rigid"].map(|name| {
        let (scene, table) = (format!("{name}.toml"), format!("{name}.csv"));
        folder.succeeds(&["run", &scene, "--method", "averaged", "--columns", columns, "--out", &table]);
        folder.read(&table)
    });
    let header: Vec<_> = text.lines().next().expect("a header").split(',').collect();
    let (rows, place) =
        (numbers(&text), |name: &str| header.iter().position(|found| found.starts_with(name)).expect(name));
    for (value, rate) in [
        ("alpha ", "alpha_rate"),
        ("beta ", "beta_rate"),
        ("gamma ", "gamma_rate"),
        ("cos_lambda ", "cos_lambda_rate"),
        ("m.n ", "m.n_rate"),
        ("psi ", "psi_rate"),
    ] {
        let (value, rate) = (place(value), place(rate));
        for near in rows.windows(3) {
            let change = near[2][value] - near[0][value];
            let slope = (change - TAU * (change / TAU).round()) / (near[2][0] - near[0][0]);
            // The square of steps of 8e-4 rad, relative to rates up to 46; the bulge changes rates by 5 %.
            assert!((slope - near[1][rate]).abs() < 1e-4, "{}: {slope} {}", header[rate], near[1][rate]);
        }
    }
    // b L.(s L) / (L.L / 2 I^xx) = l.(s l) / 2 with the traceless part of s.
    let (energy, of_rigid) = (place("E "), numbers(&of_rigid)[0][place("E ")]);
    let share = 0.5 * ((0.09 * 0.2 + 0.25 * 0.05 - 0.64 * 0.2) / 0.98 - 0.05 / 3.0);
    assert!(rows.iter().all(|row| (row[energy] / of_rigid - 1.0 - share).abs() < 1e-7), "{share}");
}

#[test]
fn dark_epochs_are_left_out_with_a_note() {
    let text = altered(PULSARS[0].name, &[("alpha_2 = 1.6e-9", "alpha_2 = 6.6e-4")]);
    let folder = Folder::with(&[("strong.toml", &text)]);
    let args = ["timing", "strong.toml", "--from", "50000", "--to", "60000.5", "--epochs", "300", "--out", "results"];
    let output = folder.succeeds(&args);
    assert!(stderr(&output).contains("of 300 epochs have no pulse"), "{}", stderr(&output));
    let count = numbers(&folder.read("results/strong.csv")).len();
    assert!((3..300).contains(&count), "{count}");
    assert!(stdout(&output).contains(&format!("{count} arrival times")));
}

/// A beam that never passes, one that is always visible, and a star at rest: each has its own message, with the closest approach and the
/// key to change.
#[test]
fn a_scene_without_pulses_is_told_why() {
    // The magnetic axis is at 75 degrees to the spin and the observer at 80 degrees: 5 and 155 degrees between them. In 15 years L moves by 1e-3 rad,
    // away from the observer.
    for (line, other, fragments) in [
        (
            "rho = ",
            "rho = 0.05",
            &[
                "never crosses the line of sight",
                "comes to 0.087266 rad of it at closest",
                "`pulsar.rho` is 0.05 rad",
                "above",
            ][..],
        ),
        (
            "rho = ",
            "rho = 3.0",
            &[
                "always inside the beam",
                "2.7062",
                "rad from it at most (0.087266 rad at closest)",
                "`pulsar.rho` is 3 rad",
                "below",
            ],
        ),
        (
            "spin_frequency = ",
            "spin_frequency = 0.0",
            &["the star does not rotate", "`star.spin_frequency` other than zero"],
        ),
    ] {
        let folder = Folder::with(&[("star.toml", &with_lines(PULSARS[0].name, &[(line, other)]))]);
        let output = ends(folder.run(&["timing", "star.toml", "--out", "results"]), 2);
        has_all(&stderr(&output), &[&["star.toml"][..], fragments].concat());
        assert!(!folder.at("results").exists() || names_in(&folder.at("results")).is_empty(), "{other}");
    }
}

/// The stated frequency of a scene is subject to the rounding of the initial momentum: arrival times are wrong by as much, linearly in
/// time, and residuals are not.
#[test]
fn the_stated_error_holds_the_rounding_of_the_start() {
    let folder = Folder::new();
    let mut worst: f64 = 0.0;
    for frequency in ["641.9282333345536", "641.9", "100.3", "57.123456789", "2.468871714699942", "-3.7"] {
        let spin = format!("spin_frequency = {frequency}");
        let text = with_lines(PULSARS[0].name, &[("spin_frequency", &spin), ("alpha_2", "alpha_2 = 0.0")]);
        folder.write("free.toml", text);
        let args = ["timing", "free.toml", "--to", "62626", "--epochs", "100", "--force", "--out", "results"];
        let output = folder.succeeds(&args);
        let (notes, summary) = (stderr(&output), stdout(&output));
        // The number in the summary agrees with that in the .par.
        let par = folder.read("results/free.par");
        let in_par = value(&par, "F0").expect("F0");
        assert!(summary.contains(&format!("F0 = {in_par} Hz")), "{summary}{in_par}");
        // In units of 1e-24 Hz.
        let exact = |text: &str| -> i128 {
            let (whole, fraction) = text.trim_start_matches('-').split_once('.').expect("a point");
            format!("{whole}{fraction:0<24}").parse().expect("digits")
        };
        let off = (exact(in_par) - exact(frequency)) as f64 * 1e-24 / exact(frequency) as f64 * 1e24;
        // The error over 20 years.
        let late = off.abs() * 7305.0 * 86_400.0;
        let stated = number_after(&notes, "estimated error of the arrival times themselves:");
        assert!(late <= stated && stated < 1e-6, "{frequency}: {late:e} s for {stated:e} s");
        let of_residuals = number_after(&notes, "estimated error of the residuals:");
        assert!(number_after(&summary, "largest ") <= of_residuals && of_residuals < 1e-11, "{summary}{notes}");
        worst = worst.max(late);
    }
    // The rounding is present, a thousand times that of the residuals.
    assert!(worst > 1e-8, "{worst:e} s");
}

/// Of epochs before that of the scene the first is the farthest. The violation is so strong that the error of the averaged motion exceeds the
/// rounding of an arrival time.
#[test]
fn the_errors_that_are_printed_are_those_at_the_farthest_epoch() {
    let toml = with_lines("b1828-11", &[("alpha_2", "alpha_2 = 1e-4")]);
    let folder = Folder::new();
    folder.write("strong.toml", &toml);
    let args = ["timing", "strong.toml", "--from", "42000", "--to", "49000", "--epochs", "9", "--out", "out"];
    let notes = stderr(&folder.succeeds(&args));
    let pulsar = PulsarScene::new(&Scene::from_toml("strong.toml", &toml).expect("a scene")).expect("a pulsar");
    // The epoch of the scene is MJD 49621.
    let farthest = (49_621.0 - 42_000.0) * 86_400.0;
    let errors = |t| [pulsar.residual_error(t), pulsar.arrival_error(t)];
    for ((what, error), at_epoch) in
        ["residuals", "arrival times themselves"].into_iter().zip(errors(farthest)).zip(errors(0.0))
    {
        assert!(error > 100.0 * at_epoch, "{what}: {error:e} s, {at_epoch:e} s at the epoch");
        has_all(&notes, &[format!("note: estimated error of the {what}: {error:.1e} s")]);
    }
}

#[test]
fn the_wave_of_a_pulsar_has_lines_at_its_frequency_and_twice_that() {
    let spectrum = succeeds(&["spectrum", "b1828-11", "--of", "h_plus"]);
    // The rate of the symmetry axis about L, 2 pi F0 plus the share of the wobble, and twice that; the slow precession splits both by 3e-17 rad/s.
    let table = stdout(&spectrum);
    let lines: Vec<f64> = cells(&table)[1..].iter().map(|row| row[0].parse().expect("a frequency")).collect();
    let near = |harmonic: f64| {
        lines.iter().filter(|w| (*w / std::f64::consts::TAU / harmonic - 2.468_871_7).abs() < 1e-6).count()
    };
    assert!(near(1.0) > 0 && near(2.0) > 0 && near(1.0) + near(2.0) == lines.len(), "{lines:?}");
}

/// Pulses requested one by one have the same numbers as in a continuous list.
#[test]
fn numbers_have_no_break() {
    let timed = |options: &[&str]| {
        let folder = Folder::new();
        folder.succeeds(&[&["timing", "b1828-11", "--to", "50000.0001", "--out", "."], options].concat());
        numbers(&folder.read("b1828-11.csv"))
    };
    let near = timed(&["--from", "50000", "--epochs", "40"]);
    let far = timed(&["--from", "49000", "--every", "333.3"]);
    let (first, last) = (&near[0], &far[far.len() - 1]);
    let days = (last[1] - first[1]) + (last[2] - first[2]);
    // The frequency and its rate at MJD 49621; F2 contributes 1e-5 of a turn, the varying torque some hundredths.
    let since = |row: &[f64]| (row[1] - 49_621.0 + row[2]) * 86_400.0;
    let lost = 0.5 * -3.6568e-13 * (since(last).powi(2) - since(first).powi(2));
    let turns = (last[0] - first[0]) - days * 86_400.0 * 2.468_871_714_7 - lost;
    assert!(turns.abs() < 0.1, "{turns}");
}

/// A span of a million years, which is allowed, has arrival times; one beyond all dates is refused at its key.
#[test]
fn a_span_in_years_is_as_long_as_is_allowed() {
    let folder = Folder::new();
    let line = 1 + altered("b1642-03", &[]).lines().position(|line| line == "[time]").expect("the section");
    for (span, status) in [("years = 1e6", 0), ("years = -1e6", 0), ("span = 1e300", 2)] {
        folder.write("long.toml", with_lines("b1642-03", &[("years", span), ("samples", "samples = 9")]));
        let message = stderr(&ends(folder.run(&["timing", "long.toml", "--force", "--out", "out"]), status));
        assert_eq!(message.contains(&format!("long.toml:{line}:1: [time] ends ")), status == 2, "{span}: {message}");
        let arrivals = folder.read("out/long.tim");
        assert_eq!(arrivals.lines().filter(|line| line.contains("-pn")).count(), 9, "{span}: {arrivals}");
    }
}

/// An error of directions by an angle delays the pulses of a slow star by that fraction of a turn.
#[test]
fn the_rounding_of_directions_is_a_part_of_a_turn() {
    let frequency = 1e-6;
    let spin = format!("spin_frequency = {frequency:?}");
    let lines =
        [("frequency", spin.as_str()), ("precession_period", "oblateness = 1e-8"), ("alpha_2", "alpha_2 = 0.0")];
    let scene = Scene::from_toml("slow", &with_lines("b1828-11", &lines)).expect("a scene");
    let scene = Scene { spin_down: None, ..scene };
    let pulsar = PulsarScene::new(&scene).expect("a pulsar");
    // Without s and at the start there is no other error; a turn takes 1e6 s, minus 1e-3 due to the precession.
    let turns = pulsar.clock.motion().rounding(0.0) / std::f64::consts::TAU;
    let error = pulsar.residual_error(0.0);
    assert!(turns / frequency > 1e-10, "{turns}");
    assert!((error * frequency / turns - 1.0).abs() < 2e-3, "{error:e} s for {turns:e} turns");
}

/// The violation is so strong that the averaged motion is wrong by microseconds: the pulses agree with `pulses`, and the residuals after 20 years are
/// exact to the rounding of an arrival time.
#[test]
fn a_strong_violation_is_timed_by_the_exact_motion() {
    let text = "[star]\nmass = 1.4\ndensity = 4e14\noblateness = 2e-3\nspin_frequency = 57.0\n[lorentz_violation]\n\
        tensor = [[2.0e-2, 1.1e-2, -0.7e-2], [1.1e-2, -0.9e-2, 0.5e-2], [-0.7e-2, 0.5e-2, -1.4e-2]]\n[initial]\nalpha = 0.4\nbeta = 0.9\n\
        gamma = 1.3\nalpha_rate = 380.0\nbeta_rate = 21.0\n[observer]\ntheta_o = 1.1\nphi_o = 0.6\n[pulsar]\nchi = 1.2\nrho = 0.6\n\
        [time]\nepoch = 59000.0\nspan = 3.0\nsamples = 40\n";
    let folder = Folder::with(&[("strong.toml", text)]);
    let listed = stdout(&folder.succeeds(&["pulses", "strong.toml"]));
    let listed: Vec<[f64; 3]> = cells(&listed)[1..]
        .iter()
        .filter(|row| row[6].is_empty())
        .map(|row| [4, 5, 8].map(|k| row[k].parse().expect("a number")))
        .collect();
    folder.succeeds(&["timing", "strong.toml", "--out", "."]);
    let mut turns = Vec::new();
    for row in numbers(&folder.read("strong.csv")).iter().skip(1) {
        let seconds = (row[1] - 59000.0 + row[2]) * 86400.0;
        let near = listed.iter().find(|pulse| (pulse[0] - seconds).abs() < 1e-10).expect("a pulse of the list");
        assert!((row[4] - near[1]).abs() < 1e-11, "{near:?}");
        turns.push(row[0] - near[2]);
    }
    assert!(turns.len() > 15 && turns.iter().all(|turn| *turn == turns[0]), "{turns:?}");
    let output =
        folder.succeeds(&["timing", "strong.toml", "--to", "66305", "--epochs", "200", "--out", ".", "--force"]);
    assert!(stderr(&output).contains("estimated error of the residuals: 8.6e-12 s"), "{}", stderr(&output));
    assert!(numbers(&folder.read("strong.csv")).len() > 50);
}
