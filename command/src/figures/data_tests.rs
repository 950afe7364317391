//! The data of figures compared with the output of other commands for the same scene, and with closed forms in SI units.

use std::f64::consts::{PI, TAU};

use super::drawn::{elements, frames};
use super::fixtures::{Fixture, OF_SCENES, OF_THE_PAPER, figure, made_up_runs, scenes};
use super::line_atlas;
use super::{OF_A_SCENE, Table};
use twofold_bench::work_precision::Row;
use twofold_scene::columns::Column;
use twofold_scene::scene_file::{Scene, Times};
use twofold_scene::trajectory::{LinesWanted, write_csv, write_lines, write_pulses};

/// The figures of the paper's examples and of the scenes, each with the scene and its name in the tables.
pub(super) fn drawn() -> Vec<(String, Scene, Vec<&'static Fixture>)> {
    let examples = [("tp-1", "tp-I"), ("tp-2", "tp-II"), ("sp-1", "sp-I"), ("sp-2", "sp-II")];
    let mut drawn = Vec::new();
    for (scene, name) in examples {
        let others = OF_THE_PAPER
            .iter()
            .filter(|figure| figure.name == format!("motion-{scene}") || !figure.name.starts_with("motion"))
            .collect();
        drawn.push((name.to_owned(), Scene::named(scene).unwrap(), others));
    }
    for (figures, (name, scene)) in OF_SCENES.iter().zip(scenes()) {
        drawn.push((name.to_owned(), scene, figures.iter().collect()));
    }
    drawn
}

/// Columns of a table of `run` or `pulses`.
struct Columns(Vec<String>, Vec<Vec<f64>>);

impl Columns {
    fn of(csv: Vec<u8>) -> Self {
        let text = String::from_utf8(csv).unwrap();
        let mut lines = text.lines();
        let heads = lines.next().unwrap().split(',').map(str::to_owned).collect();
        Self(heads, lines.map(|line| line.split(',').map(|x| x.parse().unwrap_or(f64::NAN)).collect()).collect())
    }

    fn column(&self, head: &str) -> Vec<f64> {
        let place = self.0.iter().position(|found| found == head).unwrap_or_else(|| panic!("{head} in {:?}", self.0));
        self.1.iter().map(|row| row[place]).collect()
    }
}

/// The output of `run` at times since the start.
fn run(scene: &Scene, group: &str, since_start: &[f64]) -> Columns {
    let mut scene = scene.clone();
    let start = scene.times.start();
    scene.choose_columns(&[group]).unwrap();
    scene.times = Times::Listed { start, times: since_start.iter().map(|t| start + t).collect() };
    let mut csv = Vec::new();
    write_csv(&scene, &mut csv, |_| Ok(())).unwrap();
    Columns::of(csv)
}

pub(super) fn column(table: &Table, head: &str) -> usize {
    table.columns.iter().position(|found| found == head).unwrap_or_else(|| panic!("{head} in {:?}", table.columns))
}

/// A head in the figure and that of `run`, in the units of a scene.
fn heads(scene: &Scene, what: &str) -> Vec<(&'static str, &'static str)> {
    let wave = if scene.units.are_physical() {
        ["h_+ [1]", "h_x [1]"]
    } else {
        ["h_+ [G I^xx / (c^4 t_c^2 r)]", "h_x [G I^xx / (c^4 t_c^2 r)]"]
    };
    match what {
        "angles" => vec![("alpha [rad]", "alpha [rad]"), ("beta [rad]", "beta [rad]")],
        "perturbation" => vec![
            ("alpha by perturbation printed [rad]", "alpha_printed [rad]"),
            ("beta by perturbation printed [rad]", "beta_printed [rad]"),
        ],
        "e_x" => ["e_x_X [1]", "e_x_Y [1]", "e_x_Z [1]"].map(|head| (head, head)).to_vec(),
        "e_z" => ["e_z_X [1]", "e_z_Y [1]", "e_z_Z [1]"].map(|head| (head, head)).to_vec(),
        "m.n" => vec![("m.n [1]", "m.n [1]")],
        _ => vec![(wave[0], "h_plus [1]"), (wave[1], "h_cross [1]")],
    }
}

/// Two motions at 1e-13 and 1e-14 over a hundred turns, also near a pole and as a strain with cancelling parts: 1e-9 of the largest value,
/// or of a radian, is a thousand times their difference and far below what a picture shows.
const SAME: f64 = 1e-9;

#[test]
fn the_data_of_motions_are_the_columns_of_run_from_the_start_on() {
    let mut compared = 0;
    for (name, scene, figures) in drawn() {
        let unit = if scene.units.are_physical() { "t [s]" } else { "t [t_c]" };
        let beam = if name.starts_with("tp-I") || OF_A_SCENE.len() == figures.len() { "beam-alignment" } else { "" };
        let of = |figure: &str, table: &str| {
            let figure = figures.iter().find(|found| found.name.starts_with(figure) && !figure.is_empty())?;
            figure.tables.iter().find(|found| found.name == table)
        };
        for (what, table) in [
            ("angles", of("motion", "angles")),
            ("perturbation", of("motion", "angles").filter(|_| scene.perturbation.is_ok())),
            ("e_x", of("motion", "paths")),
            ("e_z", of("motion", "paths")),
            ("m.n", of(beam, &name)),
            ("h", of(if beam.is_empty() { "" } else { "waves" }, &name)),
        ] {
            let Some(table) = table else { continue };
            // A quantity below the error of the motion is drawn as zero, and the caption says so.
            if what == "h"
                && figures.iter().any(|figure| figure.name == "waves" && figure.caption.says.contains("both are below"))
            {
                continue;
            }
            let time = column(table, unit);
            // The first time is the start, at zero on any clock of the scene.
            assert_eq!(table.rows.first().map_or(0.0, |row| row[time]), 0.0, "{name}: {what}");
            let rows: Vec<_> = table.rows.iter().skip(1).step_by(97).collect();
            if rows.is_empty() {
                continue;
            }
            let columns = run(&scene, what, &rows.iter().map(|row| row[time]).collect::<Vec<_>>());
            for (ours, theirs) in heads(&scene, what) {
                let place = column(table, ours);
                let expected = columns.column(theirs);
                let size = if what == "h" { expected.iter().fold(0.0_f64, |size, x| size.max(x.abs())) } else { 1.0 };
                for (i, (row, expected)) in rows.iter().zip(expected).enumerate() {
                    // Near a pole the accuracy of angles is that of directions over the distance from it.
                    let is_of_angles = ["angles", "perturbation"].contains(&what);
                    let beta = if is_of_angles { row[column(table, "beta [rad]")].sin() } else { 1.0 };
                    let off = (row[place] - expected).abs();
                    assert!(
                        off <= SAME * size / beta.min(1.0),
                        "{name}: {ours} is {} at row {i}, `run` has {expected}",
                        row[place]
                    );
                    compared += 1;
                }
            }
        }
    }
    assert!(compared > 5000, "{compared}");
}

#[test]
fn periods_and_lengths_are_those_of_the_pulses() {
    let mut compared = 0;
    for (name, mut scene, figures) in drawn() {
        let Some(figure) = figures.iter().find(|figure| figure.name == "pulse-series") else { continue };
        let unit = scene.units.time_name;
        let table = |what: &str| figure.tables.iter().find(|table| table.name == format!("{name}-{what}"));
        let Some((periods, lengths)) = table("periods").zip(table("lengths")) else { continue };
        let heads = |what: &str| vec![format!("t [{unit}]"), format!("{what} [{unit}]")];
        assert_eq!((&periods.columns, &lengths.columns), (&heads("period"), &heads("length")));
        let Some(last) = lengths.rows.last() else { continue };
        let (start, backwards) = (scene.times.start(), scene.times.last() < scene.times.start());
        if backwards {
            continue;
        }
        scene.times = Times::Even { start, end: start + last[0] + last[1], samples: 2 };
        let mut csv = Vec::new();
        scene.pulsar.as_mut().unwrap().second_beam = false;
        write_pulses(&scene, &mut csv, |_| Ok(())).unwrap();
        let pulses = Columns::of(csv);
        let whole: Vec<_> = pulses.column("cut").iter().map(|cut| cut.is_nan()).collect();
        let of = |head: &str| {
            let all = pulses.column(&format!("{head} [{unit}]")).into_iter().zip(&whole);
            all.filter(|(_, whole)| **whole).map(|(x, _)| x).collect::<Vec<_>>()
        };
        let (midpoints, durations) = (of("midpoint"), of("duration"));
        for row in &lengths.rows {
            let of_this = midpoints
                .iter()
                .zip(&durations)
                .find(|(midpoint, _)| (**midpoint - start - row[0]).abs() < 1e-3 * row[1]);
            let (midpoint, duration) = of_this.unwrap_or_else(|| panic!("{name}: no pulse at {}", row[0]));
            // A time of day of 12 s is rounded to 1e-15 s.
            let rounding = 4.0 * f64::EPSILON * midpoint.abs();
            assert!(
                (midpoint - start - row[0]).abs() < 1e-9 * row[1] + rounding,
                "{name}: midpoint {midpoint} and {}",
                row[0]
            );
            assert!((duration - row[1]).abs() < 1e-8 * row[1] + rounding, "{name}: duration {duration} and {}", row[1]);
            compared += 1;
        }
        for row in &periods.rows {
            let is_there = midpoints.windows(2).any(|pair| {
                let (period, middle) = (pair[1] - pair[0], 0.5 * (pair[0] + pair[1]) - start);
                let rounding = 4.0 * f64::EPSILON * pair[1].abs();
                (period - row[1]).abs() < 1e-9 * period + rounding && (middle - row[0]).abs() < 1e-9 * period + rounding
            });
            assert!(is_there, "{name}: no two pulses are {} apart about {}", row[1], row[0]);
            compared += 1;
        }
    }
    assert!(compared > 500, "{compared}");
}

/// The curves with mean rates stay in phase with those at the instant and with the pulses; those with the rates of Eq. (57) do not, as the
/// caption says.
#[test]
fn curves_with_mean_rates_keep_in_step_and_others_drift() {
    let figure = figure("pulse-series");
    let table = figure.tables.iter().find(|table| table.name == "tp-I-curves").unwrap();
    let pulses = |what: &str| figure.tables.iter().find(|table| table.name == format!("tp-I-{what}s")).unwrap();
    for what in ["period", "length"] {
        // The largest distance from the series in the last quarter of the span, over the spread of the series.
        let off = |of: &str| {
            let place = column(table, &format!("{what} {of} [t_c]"));
            let value = |t: f64| {
                let after = table.rows.partition_point(|row| row[0] < t).clamp(1, table.rows.len() - 1);
                let [a, b] = [&table.rows[after - 1], &table.rows[after]];
                a[place] + (b[place] - a[place]) * (t - a[0]) / (b[0] - a[0])
            };
            let values = pulses(what).rows.iter().map(|row| row[1]);
            let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
            let late = pulses(what).rows.iter().filter(|row| row[0] > 300.0);
            late.map(|row| (row[1] - value(row[0])).abs()).fold(0.0, f64::max) / (high - low)
        };
        let [instant, mean, first] = ["at the instant", "with mean rates", "with rates (57)"].map(off);
        assert!(
            instant < 0.2 && mean < 0.45 && first > 2.0 * mean,
            "{what}: off by {instant}, {mean}, {first} of the spread"
        );
    }
}

/// For a star in free precession about Z at the inclination `b` and the rate `a`, whose magnetic axis turns about the symmetry axis at the rate
/// `c`, `m.n` is, for an observer at the colatitude `i`,
/// `cos i (cos chi cos b - sin chi sin b cos c t) + sin i cos chi sin b cos(a t) + sin i sin chi / 2 [(1 + cos b) cos((a + c) t) - (1 - cos b) cos((a - c) t)]`
/// up to phases: four lines. The wave has the lines `a` and `2 a` of the quadrupole formula. All in SI units, from the defined constants.
#[test]
fn lines_of_free_precession_have_the_amplitudes_and_frequencies_of_the_closed_form() {
    let (_, scene, figures) = drawn().into_iter().find(|(name, ..)| name == "tone").unwrap();
    assert!(scene.units.are_physical());
    let (epsilon, b, i, chi): (f64, f64, f64, f64) = (1e-3, 0.3, 1.1, 0.7);
    let spin = TAU * 57.0;
    let a = (1.0 + epsilon) * spin / b.cos();
    let c = spin - a * b.cos();
    let lines = |figure: &str, table: &str| -> Vec<[f64; 2]> {
        let figure = figures.iter().find(|found| found.name == figure).unwrap();
        let table = figure.tables.iter().find(|found| found.name == table).unwrap();
        assert_eq!(table.columns[..2], ["frequency [Hz]", "amplitude [1]"]);
        table.rows.iter().map(|row| [row[0], row[1]]).collect()
    };
    // Mass and mean radius in SI; 1.4 solar masses by the nominal mass parameter; 2.5 kpc.
    let (gravity, light) = (6.674_30e-11, 299_792_458.0_f64);
    let (mass, radius) = (1.4 * 1.327_124_4e20 / gravity, 12e3_f64);
    let distance = 2500.0 * 648_000.0 / PI * 149_597_870_700.0;
    // (I^zz - I^xx) / I^xx = epsilon: (a3 / a1)^2 = (1 - epsilon) / (1 + epsilon), and a1^2 a3 = R^3.
    let flat = ((1.0 - epsilon) / (1.0 + epsilon)).sqrt();
    let equatorial = radius * flat.powf(-1.0 / 3.0);
    let difference = 0.2 * mass * equatorial.powi(2) * (1.0 - flat * flat);
    let h = gravity * difference * a * a / (light.powi(4) * distance);
    let (sb, cb, si, ci) = (b.sin(), b.cos(), i.sin(), i.cos());
    let (once, twice) = (a / TAU, 2.0 * a / TAU);
    let expected = [
        (
            "beam-alignment-spectra",
            "tone-lines",
            vec![
                [once, si * chi.cos() * sb],
                [(a + c) / TAU, si * chi.sin() * (1.0 + cb) / 2.0],
                [(a - c) / TAU, si * chi.sin() * (1.0 - cb) / 2.0],
                [c.abs() / TAU, ci * chi.sin() * sb],
            ],
        ),
        (
            "wave-spectra",
            "tone-plus-lines",
            vec![[once, h * (2.0 * i).sin() * sb * cb], [twice, 2.0 * h * sb * sb * (1.0 + ci * ci)]],
        ),
        ("wave-spectra", "tone-cross-lines", vec![[once, 2.0 * h * si * sb * cb], [twice, 4.0 * h * ci * sb * sb]]),
    ];
    for (figure, table, mut expected) in expected {
        let found = lines(figure, table);
        expected.sort_by(|a, b| b[1].total_cmp(&a[1]));
        assert_eq!(found.len(), expected.len(), "{table}: {found:?}, expected {expected:?}");
        for (found, expected) in found.iter().zip(&expected) {
            for (found, expected) in found.iter().zip(expected) {
                assert!((found / expected - 1.0).abs() < 1e-11, "{table}: {found}, expected {expected}");
            }
        }
    }
}

/// The level of a pulse, `cos rho`, and the rates of free precession by Eq. (48), `(1 + eps) Omega / cos beta_0` and `eps Omega`; in the
/// spectra of the wave the former and its double.
#[test]
fn levels_and_rates_are_where_they_belong() {
    let (turning, rotating) = (1.1 / 0.7_f64.cos(), 0.1);
    let mut looked = 0;
    for (name, scene, figures) in drawn() {
        let asked =
            |figure: &&Fixture| ["beam-alignment", "beam-alignment-spectra", "wave-spectra"].contains(&figure.name);
        for figure in figures.into_iter().filter(asked) {
            for frame in frames(&elements(&figure.svg)).into_iter().filter(|frame| frame.heading == name) {
                let within = |found: &[f64], expected: &[f64]| {
                    // Places are rounded to 0.01 pt, in frames of more than 50.
                    let near = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-3 * b.abs().max(1.0);
                    assert!(
                        found.len() == expected.len() && found.iter().zip(expected).all(near),
                        "{} {name}: {found:?}, expected {expected:?}",
                        figure.name
                    );
                };
                let is_of_paper = name.starts_with("tp-");
                match figure.name {
                    "beam-alignment" => within(&frame.levels, &[scene.pulsar.unwrap().rho.cos()]),
                    "beam-alignment-spectra" if is_of_paper => within(&frame.uprights, &[turning, rotating]),
                    // An inset has its own, at three times the mean rate.
                    "wave-spectra" if is_of_paper && frame.corners[2] - frame.corners[0] > 100.0 => {
                        within(&frame.uprights, &[turning, 2.0 * turning]);
                    }
                    _ => continue,
                }
                looked += 1;
            }
        }
    }
    assert!(looked > 12, "{looked}");
}

/// Times of runs are in seconds, those of the picture in milliseconds.
#[test]
fn the_times_of_methods_are_in_the_unit_of_their_axis() {
    let figure = figure("work-precision");
    let runs = made_up_runs();
    let mut compared = 0;
    for table in &figure.tables {
        assert_eq!(table.columns, ["error [1]", "time [ms]"]);
        for row in &table.rows {
            let is_this = |run: &&Row| {
                table.name.starts_with(&run.scene)
                    && table.name.ends_with(&run.method)
                    && (run.error / row[0] - 1.0).abs() < 1e-12
            };
            let run = runs.iter().find(is_this).unwrap();
            assert!((row[1] / (1e3 * run.times.least) - 1.0).abs() < 1e-12, "{}: {} ms", table.name, row[1]);
            compared += 1;
        }
    }
    assert!(compared > 300, "{compared}");
}

/// Amplitudes of the atlas agree with `spectrum` for the same star, which names the lines by other rates. The strongest line is in the atlas where
/// its two columns meet.
#[test]
fn the_atlas_has_the_lines_of_spectrum() {
    let figure = figure("line-atlas");
    let scene = |scale: f64, wobble: f64| {
        let problem = line_atlas::star(scale, wobble).unwrap();
        let (state, spheroid) = (problem.initial(), problem.spheroid());
        let (angles, rates) = (state.angles().unwrap(), state.rates(spheroid).unwrap());
        let s = problem.coefficients().diagonal();
        let text = format!(
            "star = {{ inertia_ratio = 1.1, spin = {:?} }}\nlorentz_violation.eigenvalues = [{:?}, {:?}, {:?}]\ninitial = {{ alpha = {:?}, beta = {:?}, \
             gamma = {:?}, alpha_rate = {:?}, beta_rate = {:?} }}\nobserver = {{ theta_o = 0.8, phi_o = 0.0 }}\npulsar = {{ chi = 0.5, rho = 0.6 }}\n\
             time = {{ span = 1.0, samples = 2 }}\n",
            state.momentum.dot(&state.axis) / spheroid.inertia_zz,
            s.x,
            s.y,
            s.z,
            angles.alpha,
            angles.beta,
            angles.gamma,
            rates.alpha,
            rates.beta,
        );
        Scene::from_toml("atlas", &text).unwrap()
    };
    let meeting = scene(line_atlas::SCALE, line_atlas::WOBBLE);
    for (place, (name, unit)) in
        [("m.n", "[1]"), ("h_plus", "[G I^xx / (c^4 t_c^2 r)]"), ("h_cross", "[G I^xx / (c^4 t_c^2 r)]")]
            .into_iter()
            .enumerate()
    {
        let amplitudes = |scene: &Scene| {
            let column = Column::oscillating(name, scene).unwrap();
            let wanted = LinesWanted { least: 1e-8, most: 10_000, in_turns: false };
            let mut csv = Vec::new();
            write_lines(scene, &column, &wanted, &mut csv).unwrap();
            let lines = Columns::of(csv);
            let head = lines.0.iter().find(|head| head.starts_with("amplitude")).expect("amplitudes").clone();
            lines.column(&head)
        };
        let [of_size, of_wobble] = [&figure.tables[3 * place], &figure.tables[3 * place + 1]];
        assert_eq!([&of_size.name, &of_wobble.name], [&format!("{name}-size"), &format!("{name}-wobble")]);
        assert!(of_size.columns[1..].iter().all(|head| head.ends_with(unit)), "{:?}", of_size.columns);
        let here =
            of_size.rows.iter().find(|row| (row[0] / 0.006 - 1.0).abs() < 1e-9).expect("the size of the other column");
        let there = &of_wobble.rows[of_wobble.rows.len() / 2];
        for (row, scene) in [(here, &meeting), (there, &scene(line_atlas::SCALE, there[0]))] {
            let known = amplitudes(scene);
            for (amplitude, line) in row[1..].iter().zip(&of_size.columns[1..]).filter(|(size, _)| **size > 1e-7) {
                let off = known.iter().map(|known| (known / amplitude - 1.0).abs()).fold(f64::INFINITY, f64::min);
                assert!(off < 1e-6, "{name}: no line of `spectrum` is as strong as {line}, {amplitude}");
            }
        }
        let strongest = here[1..].iter().fold(0.0_f64, |most, x| most.max(*x));
        let known = amplitudes(&meeting)[0];
        assert!((known / strongest - 1.0).abs() < 1e-9, "{name}: {known} and {strongest}");
    }
}
