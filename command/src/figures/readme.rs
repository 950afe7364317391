//! The picture of the README: a motion with the perturbation solutions, and the orders of their errors.

use super::drawing::*;
use twofold::propagation::Motion;
use twofold::solutions::perturbation::{Form, Precession};
use twofold_verify::checks::regimes::perturbation_error::Case;

const SOLUTIONS: [(Form, Line, [&str; 2]); 2] = [
    (Form::Printed, dashed(VERMILION, 1.2), ["perturbation, as printed", "as printed: order 1"]),
    (Form::Corrected, dotted(BLUE, 1.5), ["perturbation, corrected", "corrected: order 2"]),
];

/// Smallest error that is shown (rad).
const LEAST: f64 = 1e-12;

/// The picture as SVG. Left, a small tilt of the angular momentum without Lorentz violation: numerical motion and perturbation solutions from the
/// same initial values. Right, the errors of the solutions for tp-I as the coefficients for Lorentz violation are scaled.
pub fn readme_picture() -> Result<String, String> {
    let grid = Grid { left: LEFT, top: 18.0, width: 196.0, height: 136.0, between: [54.0, 0.0] };
    let mut page = Page::new("perturbation", PAGE, grid.bottom(1) + BELOW);
    let (duration, tilt) = (20.0, 0.01);
    // Both have the same tilt: A / omega as printed, A / a corrected. s is negligible but not zero, since a^(1) needs a sign.
    let tilted = |form| {
        let frequency = if form == Form::Printed { 1.1 } else { 1.1 / 0.7_f64.cos() };
        Case::paper(form, Precession::Twofold, 1e-40, 0.7, tilt * frequency)
    };
    let motion = tilted(Form::Printed).motion(duration)?;
    let beta = |t| Ok((t, motion.state(t).map_err(|error| error.to_string())?.axis.z.acos()));
    let numerical = times(duration, 600).into_iter().map(beta).collect::<Result<Vec<_>, String>>()?;
    let y = Axis::linear("*β* [rad]", 0.685, 0.725);
    let left = Panel::new(grid.frame(0, 0), Axis::linear("*t* / *t*_{c}", 0.0, duration), y);
    left.curve(&mut page, &numerical, solid(LIGHT, 3.0));
    let y = Axis::logarithmic("error [rad]", LEAST, 0.1);
    let right = Panel::new(grid.frame(1, 0), Axis::logarithmic("scale of *s*", 1e-6, 1.0), y);
    for (form, line, _) in SOLUTIONS {
        let solution = tilted(form).solution()?;
        let points: Vec<_> = times(duration, 600).into_iter().map(|t| (t, solution.at(t).beta)).collect();
        left.curve(&mut page, &points, line);
        let scales = (0..=24).map(|j| 10f64.powf(-0.25 * f64::from(j)));
        let error = |k| Ok((k, Case::paper(form, Precession::Twofold, k, 0.7, 0.0).errors(10.0, 400)?.beta));
        let mut points = scales.map(error).collect::<Result<Vec<_>, String>>()?;
        // Smaller errors are rounding.
        points.retain(|(_, error)| *error > LEAST);
        right.curve(&mut page, &points, line);
        right.marks(&mut page, &points, Mark::Disc, 1.4, line.colour);
    }
    let titles = ["free precession, *L* tilted by 0.01", "tp-I, *s* scaled: error of *β* over 10 *t*_{c}"];
    for (i, (panel, title)) in [left, right].iter().zip(titles).enumerate() {
        panel.draw_frame(&mut page);
        panel.letter(&mut page, i, 2, title);
        let names = SOLUTIONS.map(|(_, line, names)| (Sample::Line(line), names[i]));
        let motion = (Sample::Line(solid(LIGHT, 3.0)), "numerical");
        let entries: Vec<_> = (i == 0).then_some(motion).into_iter().chain(names).collect();
        legend(&mut page, [panel.frame.left + 8.0, panel.frame.top + 14.0], &entries);
    }
    Ok(page.finish("Perturbation solutions and their errors"))
}

#[cfg(test)]
mod tests {
    use super::readme_picture;

    /// The numbers of a picture, and the rest: marks, words, and colours without digits.
    fn parted(svg: &str) -> (Vec<f64>, String) {
        let is_of_number = |c: char| c.is_ascii_digit() || c == '.';
        let numbers = svg.split(|c| !is_of_number(c)).filter_map(|digits| digits.parse().ok()).collect();
        (numbers, svg.replace(is_of_number, ""))
    }

    /// Coordinates are written to 0.01. Another processor may round differently: an error of 1e-12 by a thousandth, 0.005 on the page. After a
    /// change of the drawing, redraw the picture and inspect it.
    #[test]
    fn the_picture_of_the_readme_is_the_one_that_is_drawn() {
        let (places, kept) = parted(include_str!("../../../docs/images/perturbation.svg"));
        let (found, drawn) = parted(&readme_picture().unwrap());
        assert_eq!(kept, drawn);
        assert!(places.len() == found.len() && places.len() > 1000, "{} {}", places.len(), found.len());
        for (place, found) in places.into_iter().zip(found) {
            assert!((place - found).abs() < 0.025, "{place} {found}");
        }
    }
}
