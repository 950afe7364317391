//! `h_+` and `h_x` at the observer against time.

use twofold::dynamics::{BodyState, RotationState};
use twofold::observables::gravitational_wave::Polarizations;
use twofold::units::si::KILOPARSEC;

use super::drawing::*;
use twofold_scene::wave::spheroid_wave;

pub(super) fn sheet(name: &str, subjects: &[&Subject]) -> Result<Sheet, String> {
    let tables = subjects.iter().map(|subject| waves(subject)).collect::<Result<Vec<_>, _>>()?;
    Ok(Sheet { svg: draw(name, subjects, &tables), caption: caption(subjects, &tables), tables })
}

/// The two polarizations in a state, in the unit of the figure.
pub(super) fn wave(subject: &Subject, state: &BodyState<f64>) -> Result<Polarizations<f64>, String> {
    let (problem, observer) = (&subject.problem, subject.viewer()?.basis());
    Ok(spheroid_wave(
        problem.spheroid(),
        problem.coefficients(),
        &state.axis_state(),
        &observer,
        subject.scale.wave(1.0),
    ))
}

/// The error of a wave due to that of the numerical motion, in the unit of the figure: the second derivative has products of `n` and `L` of
/// the size `epsilon Omega^2`, and the torque. A smaller wave is not significant.
pub(super) fn error(subject: &Subject) -> f64 {
    let (problem, spheroid) = (&subject.problem, subject.problem.spheroid());
    let rate = problem.initial().momentum.norm() / spheroid.inertia_xx;
    subject.scale.wave(ALIKE * (spheroid.oblateness().abs() * rate * rate + problem.coefficients().norm()))
}

fn waves(subject: &Subject) -> Result<Table, String> {
    let unit = subject.scale.wave_column_unit();
    let columns = [subject.scale.time_column("t"), format!("h_+ [{unit}]"), format!("h_x [{unit}]")];
    let mut table = Table::new(&subject.name, columns);
    for t in times(subject.shown.waves, 2000) {
        let h = wave(subject, &subject.state(t)?)?;
        table.push([subject.scale.time(t), h.plus, h.cross]);
    }
    Ok(table)
}

fn draw(name: &str, subjects: &[&Subject], tables: &[Table]) -> String {
    let grid = Grid::two_rows(subjects.len(), 74.0, 44.0);
    let mut page = Page::new(name, PAGE, grid.bottom(2) + BELOW);
    // Both stars and polarizations have the same scale, so that amplitudes can be compared.
    let values = || tables.iter().flat_map(|table| table.rows.iter().flat_map(|row| [row[1], row[2]]));
    // An insignificant wave does not fill the frame.
    let least = subjects.iter().map(|subject| error(subject)).fold(0.0, f64::max);
    let least = [-least, least].into_iter().filter(|_| !subjects.iter().zip(tables).any(|(s, t)| radiates(s, t)));
    for (i, (subject, table)) in subjects.iter().zip(tables).enumerate() {
        let x = subject.scale.time_axis(subject.shown.waves);
        for (polarization, (label, colour)) in [("*h*_{+}", BLUE), ("*h*_{×}", VERMILION)].into_iter().enumerate() {
            let frame = grid.frame(i, polarization);
            let x = if polarization == 0 { x.bare() } else { x.clone() };
            let panel =
                Panel::new(frame, x, Axis::around(&subject.scale.wave_label(label), values().chain(least.clone())));
            panel.curve(&mut page, &table.points(0, 1 + polarization), solid(colour, 0.9));
            panel.draw_frame(&mut page);
            if polarization == 0 {
                panel.letter(&mut page, i, subjects.len(), &subject.name);
            }
        }
    }
    page.finish("Gravitational waves in time")
}

/// Whether a wave exceeds the error of the motion.
fn radiates(subject: &Subject, table: &Table) -> bool {
    table.rows.iter().any(|row| row[1].abs().max(row[2].abs()) > error(subject))
}

fn caption(subjects: &[&Subject], tables: &[Table]) -> Caption {
    let text = |part| sentences("waves", part, &[("kind", subjects[0].kind().to_owned())]);
    let unit = match subjects[0].viewer().ok().and_then(|viewer| viewer.distance) {
        Some(distance) => format!(", as strain at {} kpc", significant(distance / KILOPARSEC, 4)),
        None => "; *h* *r* / *I*^{*xx*} counts multiples of *G* / (*c*^{4} *t*_{c}^{2})".to_owned(),
    };
    let range = |(subject, table): (&&Subject, &Table)| {
        let of = |column: usize| Spread::of(table.rows.iter().map(|row| row[column])).map(|spread| spread.in_words(""));
        match (of(1), of(2)) {
            (Some(plus), Some(cross)) if radiates(subject, table) => {
                format!("For {}, *h*_{{+}} is {plus} and *h*_{{×}} {cross}", subject.name)
            }
            _ => format!(
                "For {}, both are below {}, what the error of the {} motion makes",
                subject.name,
                significant(error(subject), 1),
                subject.kind()
            ),
        }
    };
    let ranges: Vec<_> = subjects.iter().zip(tables).map(range).collect();
    let mut says = format!("{}; the scales are the same.", ranges.join(". "));
    if subjects.len() > 1 {
        says += &format!(" {}", text("examples"));
    }
    Caption {
        shows: format!("Quadrupole waves *h*_{{+}} and *h*_{{×}} at the observer in time{unit}."),
        parameters: parameters(&line_of_sight(subjects, false), subjects),
        method: text("method"),
        says,
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix3, Vector3};
    use twofold::dynamics::{Problem, RigidSpheroid};
    use twofold::euler_angles::EulerAngles;

    use super::*;
    use crate::figures::caption_tests::assert_begins;
    use crate::figures::fixtures::{free, tone};

    /// It is proportional to the oblateness and to the square of the rotation, with a term for the torque.
    #[test]
    fn the_error_of_a_wave_goes_with_what_makes_it() {
        let error = |oblateness: f64, rate: f64, torque: f64| {
            let spheroid = RigidSpheroid { inertia_xx: 2.0, inertia_zz: 2.0 * (1.0 + oblateness), constant_c: 1.0 };
            let momentum = Vector3::x() * (2.0 * rate);
            let start = BodyState { axis: Vector3::z(), momentum, equatorial_axis: Vector3::x() };
            let s = Matrix3::from_diagonal(&Vector3::new(torque, 0.0, 0.0));
            let problem = Problem::new(spheroid, s, start).unwrap();
            super::error(
                &Subject::new("star", problem, EulerAngles { alpha: 0.0, beta: 0.0, gamma: 0.0 }, 1.0).unwrap(),
            )
        };
        let unit = error(0.1, 1.0, 0.0);
        assert!(unit > 0.0);
        for (oblateness, rate, torque, times) in [
            (-0.1, 1.0, 0.0, 1.0),
            (0.2, 1.0, 0.0, 2.0),
            (0.1, 3.0, 0.0, 9.0),
            (0.1, 1.0, 0.1, 2.0),
            (0.0, 1.0, 0.1, 1.0),
            (0.0, 1.0, 0.0, 0.0),
        ] {
            let found = error(oblateness, rate, torque) / unit;
            assert!((found - times).abs() < 1e-9, "{oblateness} {rate} {torque}: {found}");
        }
    }

    fn table(rows: &[[f64; 2]]) -> Table {
        let mut table = Table::new("", ["t", "h_+", "h_x"]);
        rows.iter().for_each(|[plus, cross]| table.push([0.0, *plus, *cross]));
        table
    }

    #[test]
    fn a_wave_is_more_than_the_error_of_the_motion_of_either_sign() {
        let star = free("a");
        let error = super::error(&star);
        for row in [[1.1, 0.0], [-1.1, 0.0], [0.0, 1.1], [0.0, -1.1]] {
            assert!(radiates(&star, &table(&[[0.0, 0.0], row.map(|part| part * error)])), "{row:?}");
        }
        assert!(!radiates(&star, &table(&[[0.9, -0.9].map(|part| part * error)])));
    }

    /// The error is `1e-11 epsilon (1.1 / cos 0.7)^2`; the distance of the physical star is 2.5 kpc.
    #[test]
    fn a_caption_tells_the_ranges_and_the_unit() {
        let (first, second) = (free("a"), free("b"));
        let (wave, none) = (table(&[[-0.25, 0.5], [0.125, 2.0]]), table(&[[0.0, 0.0]]));
        assert_begins(
            &caption(&[&first, &second], &[wave.clone(), none]),
            [
                "Quadrupole waves *h*_{+} and *h*_{×} at the observer in time; *h* *r* / *I*^{*xx*} counts multiples of",
                "*θ*_{o} = 0.8, *φ*_{o} = 0. *ε* = 0.1",
                "Of the numerical motion, the second time derivative",
                "For a, *h*_{+} is from −0.25 to 0.125 and *h*_{×} from 0.5 to 2. For b, both are below 2 × 10^{−12}, what the error of the \
                 numerical motion makes; the scales are the same. For tp-I",
            ],
        );
        let alone = caption(&[&tone(1.0, 1.0)], &[wave]);
        assert!(alone.shows.ends_with("in time, as strain at 2.5 kpc."), "{}", alone.shows);
        assert!(alone.says.ends_with("; the scales are the same."), "{}", alone.says);
    }
}
