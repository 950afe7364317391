//! Euler angles against time with perturbation solutions, and the paths of `e_x` and `e_z` on the unit sphere.

use nalgebra::Vector3;
use twofold::solutions::perturbation::Perturbation;

use super::drawing::*;

const NUMERICAL: Line = solid(BLACK, 0.9);
/// Lines of the solutions of a subject, in its order.
const SOLUTIONS: [Line; 2] = [dashed(VERMILION, 1.2), dotted(BLUE, 1.5)];

const E_X: Line = solid(GREEN, 0.5);
const E_Z: Line = solid(BLUE, 1.1);

pub(super) fn sheet(name: &str, subjects: &[&Subject]) -> Result<Sheet, String> {
    let subject = subjects[0];
    let tables = vec![angles(subject)?, paths(subject)?];
    Ok(Sheet { svg: draw(name, subject, &tables), caption: caption(subject, &tables[0]), tables })
}

/// Perturbation solutions with the initial values of the motion, and their names.
fn solutions(subject: &Subject) -> Vec<(&'static str, Perturbation<f64>)> {
    let both = [("perturbation, printed", subject.printed.ok()), ("perturbation, corrected", subject.corrected)];
    both.into_iter().filter_map(|(name, solution)| Some((name, solution?))).collect()
}

fn angles(subject: &Subject) -> Result<Table, String> {
    let mut columns = vec![subject.scale.time_column("t"), "alpha [rad]".to_owned(), "beta [rad]".to_owned()];
    for (name, _) in solutions(subject) {
        columns.extend(["alpha", "beta"].map(|angle| format!("{angle} by {} [rad]", name.replace(", ", " "))));
    }
    let mut table = Table::new("angles", columns);
    for (t, angles) in subject.angles(&times(subject.shown.angles, 2000))? {
        let mut row = vec![subject.scale.time(t), angles.alpha, angles.beta];
        for (_, solution) in solutions(subject) {
            let approximate = solution.at(t);
            row.extend([approximate.alpha, approximate.beta]);
        }
        table.push(row);
    }
    Ok(table)
}

fn paths(subject: &Subject) -> Result<Table, String> {
    let axes = ["e_x", "e_z"].iter().flat_map(|axis| ["X", "Y", "Z"].map(|i| format!("{axis}_{i} [1]")));
    let mut table = Table::new("paths", std::iter::once(subject.scale.time_column("t")).chain(axes));
    for t in times(subject.shown.angles, 6000) {
        let state = subject.state(t)?;
        let (x, z) = (state.equatorial_axis, state.axis);
        table.push([subject.scale.time(t), x.x, x.y, x.z, z.x, z.y, z.z]);
    }
    Ok(table)
}

fn draw(name: &str, subject: &Subject, tables: &[Table]) -> String {
    let [angles, paths] = tables else { unreachable!("two tables") };
    let height = 208.0;
    let mut page = Page::new(name, PAGE, height);
    let panel_height = (height - 24.0 - 10.0 - BELOW) / 2.0;
    let frame = |i: usize| Rectangle {
        left: LEFT,
        top: 24.0 + (panel_height + 10.0) * i as f64,
        width: 268.0,
        height: panel_height,
    };
    let x = subject.scale.time_axis(subject.shown.angles);
    let solutions = solutions(subject);
    let columns = |angle: usize| (0..=solutions.len()).map(move |i| 1 + angle + 2 * i);
    let range = |angle: usize| {
        // A solution may leave the frame; the motion must not.
        let values = |column: usize| angles.rows.iter().map(move |row| row[column]);
        let (low, high) = bounds(values(1 + angle));
        let room = 0.8 * (high - low);
        let near = columns(angle).flat_map(values).filter(|v| (low - room..=high + room).contains(v));
        near.collect::<Vec<_>>()
    };
    let panels = [
        Panel::new(frame(0), x.bare(), Axis::around("*α* [rad]", range(0))),
        Panel::new(frame(1), x, Axis::around("*β* [rad]", range(1))),
    ];
    let lines = std::iter::once(NUMERICAL).chain(SOLUTIONS).collect::<Vec<_>>();
    for (angle, panel) in panels.iter().enumerate() {
        for (column, line) in columns(angle).zip(&lines) {
            panel.curve(&mut page, &angles.points(0, column), *line);
        }
        if angles.rows.is_empty() {
            panel.remark(&mut page, "the axis is on a pole: no angles");
        }
        panel.draw_frame(&mut page);
    }
    heading(&mut page, [LEFT, 12.0], 'a', "");
    let names = std::iter::once(("numerical", 66.0)).chain(solutions.iter().map(|(name, _)| (*name, 104.0)));
    let entries: Vec<_> =
        lines.iter().zip(names).map(|(line, (name, width))| (Sample::Line(*line), name, width)).collect();
    legend_row(&mut page, [LEFT + 18.0, 12.0], &entries);

    heading(&mut page, [346.0, 12.0], 'b', "");
    let view = View::new([418.0, 112.0], 74.0, 35.0, 25.0);
    view.draw_sphere(&mut page);
    view.draw_axes(&mut page, 1.22, ["*X*", "*Y*", "*Z*"]);
    let points =
        |from: usize| paths.rows.iter().map(move |row| (row[0], Vector3::new(row[from], row[from + 1], row[from + 2])));
    let shown = subject.scale.time(subject.shown.equatorial_axis).abs();
    let equatorial: Vec<_> = points(1).filter(|(t, _)| t.abs() <= shown).map(|(_, v)| v).collect();
    let axis: Vec<_> = points(4).map(|(_, v)| v).collect();
    view.line_on_sphere(&mut page, &equatorial, E_X, Some(Line { colour: "#9fd4c4", ..E_X }));
    view.line_on_sphere(&mut page, &axis, E_Z, Some(Line { colour: "#94bcd9", ..E_Z }));
    view.arrow(&mut page, &equatorial[0], solid(GREEN, 1.4));
    view.arrow(&mut page, &axis[0], solid(BLUE, 1.4));
    view.name_beside(&mut page, &equatorial[0], [-4.0, 11.0], GREEN, "**e**_{*x*}");
    view.name_beside(&mut page, &axis[0], [-9.0, -9.0], BLUE, "**e**_{*z*}");
    page.finish(&format!("Euler angles and body axes of {}", subject.name))
}

fn bounds(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)))
}

fn caption(subject: &Subject, angles: &Table) -> Caption {
    let (scale, shown) = (&subject.scale, subject.shown);
    let errors = solutions(subject).into_iter().enumerate().map(|(i, (name, _))| {
        let worst = |column: usize| {
            angles.rows.iter().map(|row| (row[column + 2 * i + 2] - row[column]).abs()).fold(0.0, f64::max)
        };
        format!("{name}: up to {} rad in *α* and {} rad in *β*", significant(worst(1), 2), significant(worst(2), 2))
    });
    let errors: Vec<_> = errors.collect();
    let inclination = Spread::of(angles.rows.iter().map(|row| row[2]));
    let says = match (inclination, &subject.printed) {
        (None, _) => "The symmetry axis stays on a pole, where the Euler angles are not defined.".to_owned(),
        (Some(inclination), Err(why)) => {
            format!("*β* is {}. No perturbation solution is drawn: {why}.", inclination.in_words(" rad"))
        }
        (Some(_), Ok(_)) => {
            format!("Differences from the {} motion over the span shown: {}.", subject.kind(), errors.join("; "))
        }
    };
    let solutions = match (subject.printed, subject.corrected) {
        (Err(_), None) => "",
        (_, None) => " Perturbation: Eqs. (30)-(33) as printed.",
        (_, Some(_)) => {
            " Perturbation: Eqs. (30)-(33) as printed, and corrected, with the first-order term that Eq. (29) lacks."
        }
    };
    let in_unit = |t: f64| format!("{} {}", number(scale.time(t)), scale.time_unit());
    let spans = [("tight", in_unit(shown.equatorial_axis)), ("wide", in_unit(shown.angles))];
    let words: Vec<_> = spans.into_iter().chain([("name", subject.name.clone())]).collect();
    Caption {
        shows: sentences("motion", "shows", &words),
        parameters: parameters("", &[subject]),
        method: sentences("motion", subject.kind(), &[]) + solutions,
        says,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures::caption_tests::assert_begins;
    use crate::figures::fixtures::{ANGLES, free, star};

    /// Columns: time, both angles, and both angles by each solution.
    #[test]
    fn a_caption_tells_the_largest_differences_from_the_motion() {
        let mut angles = Table::new("angles", ["t", "a", "b", "a printed", "b printed", "a corrected", "b corrected"]);
        angles.push([0.0, 1.0, 0.5, 1.25, 0.5, 1.0, 0.5]);
        angles.push([1.0, 2.0, 0.75, 1.5, 0.625, 2.03125, 0.75]);
        angles.push([2.0, 3.0, 0.5, 3.125, 0.515625, 3.0, 0.25]);
        assert_begins(
            &caption(&free("a"), &angles),
            [
                "a. (a) Euler angles *α* and *β* in time. (b) Paths of the heads of **e**_{*x*} (thin, green; for *t* up to 5 *t*_{c})",
                "*ε* = 0.1",
                "Numerical: Taylor series of the regular equations of motion, Eq. (25) without its poles. Perturbation: Eqs. (30)-(33) as \
                 printed, and corrected",
                "Differences from the numerical motion over the span shown: perturbation, printed: up to 0.5 rad in *α* and 0.12 rad in *β*; \
                 perturbation, corrected: up to 0.031 rad in *α* and 0.25 rad in *β*.",
            ],
        );
        let without = star("b", 1.0, [0.0; 3], ANGLES);
        let says = caption(&without, &angles).says;
        assert!(says.starts_with("*β* is from 0.5 to 0.75 rad. No perturbation solution is drawn: "), "{says}");
        let says = caption(&without, &Table::new("angles", ["t", "a", "b"])).says;
        assert_eq!(says, "The symmetry axis stays on a pole, where the Euler angles are not defined.");
    }
}
