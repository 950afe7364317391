//! Scene files: every built-in scene is accepted and agrees with its description, every bad one is refused for the expected reason.

use std::f64::consts::FRAC_PI_2;
use std::fs;
use std::path::Path;

use twofold::numerics::angle::wrapped;
use twofold::observables::pulsar::direction::magnetic_axis_direction;
use twofold::observables::pulsar::position_angle::rotating_vector_position_angle;
use twofold_scene::columns;
use twofold_scene::scene_file::{BUILT_IN, COLUMN_GROUPS, Scene, column_group};
use twofold_scene::trajectory;
use twofold_verify::refused_files::refused_files;

#[test]
fn every_built_in_scene_runs() {
    assert_eq!(BUILT_IN.len(), 10);
    for built_in in BUILT_IN {
        let scene = Scene::named(built_in.name).unwrap_or_else(|error| panic!("{error}"));
        assert!(!scene.about.is_empty() && scene.about.len() < 100, "{}", built_in.name);
        let summary = trajectory::write_csv(&scene, std::io::sink(), |_| Ok(())).expect(built_in.name);
        assert_eq!(summary.rows, scene.times.iter().count(), "{}", built_in.name);
        assert_eq!(summary.rows_on_pole, 0, "{}", built_in.name);
    }
}

/// Captions of the figures of the four examples: alpha, beta and their rates at t = 0, to the three printed decimals.
#[test]
fn the_four_examples_start_as_the_captions_say() {
    let captions =
        [("tp-1", [0.701, 1.509]), ("tp-2", [1.065, 0.889]), ("sp-1", [0.671, -0.068]), ("sp-2", [1.146, -0.008])];
    for (name, [beta, alpha_rate]) in captions {
        let scene = Scene::named(name).expect(name);
        let angles = scene.problem.initial().angles().expect(name);
        let rates = scene.problem.initial().rates(scene.problem.spheroid()).expect(name);
        let differences =
            [angles.alpha - FRAC_PI_2, angles.beta - beta, angles.gamma, rates.alpha - alpha_rate, rates.beta];
        let printed_to = [1e-15, 5e-4, 1e-15, 5e-4, 1e-15];
        for (difference, bound) in differences.into_iter().zip(printed_to) {
            assert!(difference.abs() <= bound, "{name}: off by {difference:e}");
        }
    }
}

/// The examples of `docs/scenes.md`, verbatim.
#[test]
fn the_documented_scenes_run() {
    let page = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/scenes.md")).expect("page");
    let examples: Vec<_> = page.split("```toml\n").skip(1).filter_map(|rest| rest.split("```").next()).collect();
    assert_eq!(examples.len(), 3);
    for example in examples {
        let scene = Scene::from_toml("docs/scenes.md", example).unwrap_or_else(|error| panic!("{error}"));
        trajectory::write_csv(&scene, std::io::sink(), |_| Ok(())).expect("motion");
    }
}

#[test]
fn every_bad_scene_is_refused_for_the_reason_expected() {
    let files = refused_files("bad-scenes");
    for (file, expected) in &files {
        let message = Scene::named(file).expect_err(file).to_string();
        for fragment in expected {
            assert!(message.contains(fragment), "{file}: expected `{fragment}` in\n{message}");
        }
    }
    assert!(files.len() >= 95, "only {} bad scenes found", files.len());
}

/// A tensor given in a rotated frame describes the same physics: the motion of the rotated star is the rotated motion.
#[test]
fn a_tensor_in_a_rotated_frame_gives_the_rotated_motion() {
    // A quarter turn about X: (X, Y, Z) -> (X, -Z, Y), so that s^ZZ of tp-1 becomes s^YY.
    let constants = "[initial]\nkind = \"twofold\"\nalpha_0 = 1.5707963267948966\nbeta_0 = 0.7\namplitude = 0.0\n\
                     phase = 1.5707963267948966\n[time]\nspan = 10.0\nsamples = 3\n[star]\ninertia_ratio = 1.1\nspin = 1.0\n";
    let turned = format!("{constants}[lorentz_violation]\ntensor = [[0.02, 0, 0], [0, -0.04, 0], [0, 0, 0.01]]\n");
    let principal = format!("{constants}[lorentz_violation]\neigenvalues = [0.02, 0.01, -0.04]\n");
    let turned = Scene::from_toml("turned", &turned).expect("turned");
    let principal = Scene::from_toml("principal", &principal).expect("principal");
    let (a, b) = (turned.problem.initial(), principal.problem.initial());
    let along = |v: nalgebra::Vector3<f64>| [v.x.abs(), v.y.abs(), v.z.abs()];
    let expected = |v: nalgebra::Vector3<f64>| [v.x.abs(), v.z.abs(), v.y.abs()];
    for (turned, principal) in [(a.axis, b.axis), (a.momentum, b.momentum), (a.equatorial_axis, b.equatorial_axis)] {
        for (x, y) in along(turned).into_iter().zip(expected(principal)) {
            assert!((x - y).abs() < 1e-15, "{x} instead of {y}");
        }
    }
    let n = a.axis;
    let energy_of_axis =
        n.dot(&(turned.problem.coefficients() * n)) - b.axis.dot(&(principal.problem.coefficients() * b.axis));
    assert!(energy_of_axis.abs() < 1e-16, "{energy_of_axis:e}");
}

/// The wobble, the precession period and the pulse frequency determine angles, rates, oblateness and spin; degrees are converted to radians. For
/// B1828-11 the latter follow by hand from `epsilon Omega^z = 2 pi / T` and `2 pi F0 = Omega^z ((1 + epsilon) / cos theta - epsilon)`.
#[test]
fn what_is_observed_of_a_pulsar_stands_for_its_star() {
    let observed = Scene::named("b1828-11").expect("a scene");
    let toml = twofold_scene::scene_file::built_in("b1828-11").expect("built in").toml;
    let (start, rest) = (toml.find("[initial]").expect("a section"), toml.find("[observer]").expect("a section"));
    let by_hand = toml[..start]
        .replace("precession_period = 500.0", "oblateness = 9.38886993556628e-09")
        .replace("frequency = 2.4688717147", "spin_frequency = 2.4654882117878643");
    let initial =
        "[initial]\nalpha = 0.0\nbeta = 0.05235987755982989\nalpha_rate = 15.512378628558416\nbeta_rate = 0.0\n";
    let by_hand = format!("{by_hand}{initial}{}", toml[rest..].replace("\"89.0 deg\"", "1.5533430342749532"));
    let by_hand = Scene::from_toml("by hand", &by_hand).unwrap_or_else(|error| panic!("{error}"));
    let (a, b) = (&observed.problem, &by_hand.problem);
    assert!((a.spheroid().oblateness() / b.spheroid().oblateness() - 1.0).abs() < 1e-7);
    let (a, b) = (a.initial(), b.initial());
    for (x, y) in [(a.axis, b.axis), (a.momentum, b.momentum), (a.equatorial_axis, b.equatorial_axis)] {
        assert!((x - y).norm() < 1e-13 * y.norm(), "{x:?} {y:?}");
    }
    assert!((observed.pulsar.expect("a beam").chi - by_hand.pulsar.expect("a beam").chi).abs() < 1e-15);
    // With other angles, by the definitions: n to L, and the magnetic axis to L about n.
    let lines = [
        ("wobble = \"3.0 deg\"", "wobble = 0.7\nmomentum = [1.0, -2.0, 0.5]"),
        ("azimuth = \"-90 deg\"", "azimuth = 2.0"),
        ("precession_phase = \"90 deg\"", "precession_phase = 0.4"),
        ("chi = \"89.0 deg\"", "chi = 1.2\ndelta = 0.9"),
        ("frequency = 2.4688717147", "frequency = -3.5"),
    ];
    let text = lines.iter().fold(toml.to_owned(), |text, (from, to)| text.replace(from, to));
    let scene = Scene::from_toml("other", &text).unwrap_or_else(|error| panic!("{error}"));
    let state = scene.problem.initial();
    let (n, l) = (state.axis, state.momentum.normalize());
    assert!((l - nalgebra::Vector3::new(1.0, -2.0, 0.5).normalize()).norm() < 1e-15);
    // A negative frequency: the wobble and its phase are angles to -L.
    assert!((n.angle(&-l) - 0.7).abs() < 1e-15);
    let m = scene.pulsar.expect("a beam").beam().direction(state);
    let across = |v: nalgebra::Vector3<f64>| (v - n * n.dot(&v)).normalize();
    let phase = n.dot(&across(m).cross(&across(-l))).atan2(across(m).dot(&across(-l)));
    assert!((phase - 0.4).abs() < 1e-14 && (m.angle(&n) - 1.2).abs() < 1e-14, "{phase}");
}

/// The observer at an angle to L, and in the direction opposite to the star's place in the sky.
#[test]
fn an_observer_is_given_by_inclination_or_by_the_place_of_the_star() {
    let toml = twofold_scene::scene_file::built_in("b1937+21").expect("built in").toml;
    let (start, end) = (toml.find("\ntheta_o").expect("a key"), toml.find("\ndistance").expect("a key"));
    let with = |lines: &str| {
        let text = format!("{}\n{lines}{}", &toml[..start], &toml[end..]);
        Scene::from_toml("observed", &text)
    };
    let scene = with("inclination = \"40 deg\"\nazimuth = 0.7").unwrap_or_else(|error| panic!("{error}"));
    let (l, o) = (scene.problem.initial().momentum.normalize(), scene.observer.expect("an observer").basis().direction);
    assert!((o.angle(&l) - 40.0_f64.to_radians()).abs() < 1e-14);
    let x = (nalgebra::Vector3::x() - l * l.x).normalize();
    let azimuth = l.dot(&x.cross(&o)).atan2(x.dot(&o));
    assert!((azimuth - 0.7).abs() < 1e-14, "{azimuth}");
    let scene = with("frame = \"equatorial\"").unwrap_or_else(|error| panic!("{error}"));
    // 19:39:38.561224, +21:34:59.12570.
    let right = (19.0 + (39.0 + 38.561224 / 60.0) / 60.0) * 15.0_f64.to_radians();
    let up = (21.0 + (34.0 + 59.1257 / 60.0) / 60.0) * 1.0_f64.to_radians();
    let star = nalgebra::Vector3::new(up.cos() * right.cos(), up.cos() * right.sin(), up.sin());
    assert!((scene.observer.expect("an observer").basis().direction + star).norm() < 1e-14);
    for (lines, reasons) in [
        ("inclination = 4.0", ["`observer.inclination` = 4.0", "0 to pi"]),
        (
            "theta_o = 1.0\nphi_o = 0.0\ninclination = 1.0",
            ["`observer.inclination` cannot be used with `observer.theta_o`", "only one"],
        ),
        (
            "theta_o = 1.0\nphi_o = 0.0\nazimuth = 1.0",
            ["`observer.theta_o` cannot be used with `observer.azimuth`", "only one"],
        ),
        ("frame = \"galactic\"", ["`observer.frame` = \"galactic\"", "equatorial"]),
        ("azimuth = 1.0", ["`observer.theta_o`", "colatitude"]),
    ] {
        let error = with(lines).expect_err(lines).to_string();
        assert!(reasons.iter().all(|reason| error.contains(reason)), "{lines}: {error}");
    }
}

/// A physical star has the same motion in other units.
#[test]
fn a_physical_star_moves_as_in_its_own_units() {
    let rest = "[initial]\nalpha = 0.3\nbeta = 0.7\n[lorentz_violation]\neigenvalues = [0.02, 0.01, -0.04]\n";
    let star = "[star]\nmass = 1.4\nradius = 12.0\noblateness = 0.1\nspin_frequency = 50.0\n";
    let read = |text: &str| Scene::from_toml("scene", text).unwrap_or_else(|error| panic!("{error}"));
    let rates = "alpha_rate = 20.0\nbeta_rate = 3.0\n[time]\nspan = 0.1\nsamples = 5\n";
    let physical = read(&format!("{star}{}", rest.replace("0.7\n", &format!("0.7\n{rates}"))));
    let unit = physical.units.time;
    let rates = format!(
        "alpha_rate = {:?}\nbeta_rate = {:?}\n[time]\nspan = {:?}\nsamples = 5\n",
        20.0 * unit,
        3.0 * unit,
        0.1 / unit
    );
    let spin = std::f64::consts::TAU * 50.0 * unit;
    let star = format!("[star]\ninertia_ratio = 1.1\nspin = {spin:?}\n");
    let dimensionless = read(&format!("{star}{}", rest.replace("0.7\n", &format!("0.7\n{rates}"))));
    let (in_seconds, in_tc) = (numbers(&csv(&physical)), numbers(&csv(&dimensionless)));
    let (momentum, energy) = (physical.units.momentum, physical.units.energy);
    let mut factors = vec![unit, 1.0, 1.0, 1.0];
    factors.extend([1.0 / unit; 3]);
    factors.extend([1.0; 6]);
    factors.extend([momentum; 3]);
    factors.extend([energy, 1.0 / unit, momentum * momentum]);
    for (seconds, tc) in in_seconds.iter().zip(&in_tc) {
        assert_eq!(seconds.len(), factors.len());
        for ((x, y), factor) in seconds.iter().zip(tc).zip(&factors) {
            // The motion is accurate to 1e-13 per component; components are compared against one.
            assert!((x / factor - y).abs() < 1e-11 * y.abs().max(1.0), "{x} / {factor} instead of {y}");
        }
    }
}

/// The table of a scene.
fn csv(scene: &Scene) -> Vec<u8> {
    let mut table = Vec::new();
    trajectory::write_csv(scene, &mut table, |_| Ok(())).expect("motion");
    table
}

/// Rows of numbers of a table without empty fields.
fn numbers(table: &[u8]) -> Vec<Vec<f64>> {
    let text = std::str::from_utf8(table).expect("text");
    let row = |line: &str| line.split(',').map(|field| field.parse().expect("number")).collect();
    text.lines().skip(1).map(row).collect()
}

/// A scene with the columns `names` and its table.
fn table_of(mut scene: Scene, names: &[&str]) -> Vec<Vec<f64>> {
    scene.choose_columns(names).expect("columns");
    numbers(&csv(&scene))
}

#[test]
fn columns_are_those_asked_for_in_their_order() {
    let mut scene = Scene::named("tp-1").expect("tp-1");
    assert_eq!(
        scene.columns,
        ["angles", "rates", "e_x", "e_z", "L", "integrals"].map(|name| column_group(name).expect("a group"))
    );
    scene.choose_columns(&["h", "e_z", "lambda"]).expect("columns");
    let expected = [
        "t [t_c]",
        "e_z_X [1]",
        "e_z_Y [1]",
        "e_z_Z [1]",
        "cos_lambda [1]",
        "cos_lambda_rate [1/t_c]",
        "h_plus [1]",
        "h_cross [1]",
    ];
    assert_eq!(trajectory::header(&scene), expected);
    for names in [&["h", "h"][..], &["H"], &[], &["corrected"]] {
        assert!(scene.choose_columns(names).is_err(), "{names:?}");
    }
    assert_eq!(trajectory::header(&scene), expected, "a refusal changes nothing");
    for (name, group) in COLUMN_GROUPS {
        let mut scene = Scene::named("tp-1").expect("tp-1");
        scene.choose_columns(&[name]).unwrap_or_else(|why| panic!("{why}"));
        let width = columns::header(group, &scene.units).len() + 1;
        assert!(numbers(&csv(&scene)).iter().all(|row| row.len() == width), "{name}");
    }
}

/// Each rate column is the slope of the neighbouring column, and the direction of the magnetic axis is Eq. (49).
#[test]
fn columns_of_observables_agree_with_one_another() {
    let scene = || {
        let toml = BUILT_IN.iter().find(|scene| scene.name == "tp-2").expect("tp-2").toml;
        let toml = toml.replace("span = 400", "span = 2").replace("samples = 4001", "samples = 2001");
        Scene::from_toml("tp-2", &toml).unwrap_or_else(|error| panic!("{error}"))
    };
    let rows = table_of(scene(), &["lambda", "m.n", "magnetic_axis", "e_z", "angles", "position_angle"]);
    let step = rows[1][0] - rows[0][0];
    for triple in rows.windows(3) {
        // t, alpha, beta, gamma, e_z (3), cos lambda, rate, m.n, rate, Theta, Phi, psi, rate
        for value in [7, 9] {
            let slope = (triple[2][value] - triple[0][value]) / (2.0 * step);
            assert!((slope - triple[1][value + 1]).abs() < 1e-5, "column {value}: {slope}");
        }
        let slope = wrapped(triple[2][13] - triple[0][13]) / (2.0 * step);
        assert!((slope - triple[1][14]).abs() < 1e-4, "psi: {slope} instead of {}", triple[1][14]);
        let row = &triple[1];
        let psi = rotating_vector_position_angle(row[11], row[12], 0.8, 0.0).expect("off the line of sight");
        assert!(wrapped(psi - row[13]).abs() < 1e-11, "{row:?}");
        let angles = twofold::euler_angles::EulerAngles { alpha: row[1], beta: row[2], gamma: row[3] };
        let (theta, phi) = magnetic_axis_direction(&angles, 0.5, 0.0).expect("off the pole");
        assert!((theta - row[11]).abs() < 1e-12 && wrapped(phi - row[12]).abs() < 1e-12, "{row:?}");
        assert!((row[7] - (0.8_f64.sin() * row[4] + 0.8_f64.cos() * row[6])).abs() < 1e-15);
    }
}

/// The perturbation columns start with the motion; the strain of a physical star is that of the paper's units times
/// `G I^xx / (c^4 t_c^2 r)`.
#[test]
fn perturbation_starts_with_the_motion_and_strain_scales() {
    for name in ["tp-1", "tp-2", "sp-1", "sp-2"] {
        let rows = table_of(Scene::named(name).expect(name), &["angles", "perturbation"]);
        assert!((rows[0][1] - rows[0][4]).abs() < 1e-15 && (rows[0][2] - rows[0][5]).abs() < 1e-15, "{name}");
    }
    let scene = |star: &str, rate: f64, span: f64, observer: &str| {
        let text = format!(
            "[star]\n{star}\n[lorentz_violation]\neigenvalues = [0.02, 0.01, -0.04]\n[initial]\nalpha = 0.3\nbeta = 0.7\n\
             alpha_rate = {rate:?}\nbeta_rate = 0.0\n[observer]\ntheta_o = 0.8\nphi_o = 0.1\n{observer}\n[time]\n\
             span = {span:?}\nsamples = 5\n"
        );
        Scene::from_toml("scene", &text).unwrap_or_else(|error| panic!("{error}"))
    };
    let star = "mass = 1.4\nradius = 12.0\noblateness = 0.1\nspin_frequency = 50.0";
    let physical = |observer: &str| scene(star, 20.0, 0.1, observer);
    let units = physical("distance = 1.0").units;
    let spin = std::f64::consts::TAU * 50.0 * units.time;
    let paper = scene(&format!("inertia_ratio = 1.1\nspin = {spin:?}"), 20.0 * units.time, 0.1 / units.time, "");
    // I^xx / t_c^2 in SI; G / c^4 = 8.2627e-45 s^2 / (kg m); 1 kpc = 3.0857e19 m.
    let unit = 8.262_7e-45 * (units.momentum * 1e-7 / units.time) / 3.085_677_6e19;
    let (near, far) = (table_of(physical("distance = 1.0"), &["h"]), table_of(physical("distance = 10.0"), &["h"]));
    for ((near, far), paper) in near.iter().zip(&far).zip(table_of(paper, &["h"])) {
        for i in [1, 2] {
            assert!((near[i] / unit - paper[i]).abs() < 1e-4 * paper[i].abs().max(1e-3), "{near:?} {paper:?}");
            assert!((near[i] / far[i] - 10.0).abs() < 1e-12);
        }
    }
}
