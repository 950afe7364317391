//! Error of the perturbation solutions as a function of their parameters.

use twofold::lorentz_violation::PrincipalCoefficients;
use twofold::solutions::perturbation::{Form, Precession};

use super::contour::{bands, isoline};
use super::drawing::*;
use twofold_verify::checks::regimes::perturbation_error::Case;

/// `beta_0` of the columns of the maps.
const INCLINATIONS: (f64, f64, usize) = (0.05, 1.5, 30);

/// Powers of ten of the second parameter, `A` or the asymmetry.
const POWERS: (f64, f64, usize) = (-4.0, 0.0, 24);
const ASYMMETRY_POWERS: (f64, f64, usize) = (-2.0, 0.0, 20);

/// Scale of `s` in the maps of twofold precession.
const SCALE: f64 = 0.1;

/// Time over which the error of twofold precession is taken, in `t_c`.
const DURATION: f64 = 10.0;

/// `|2 s^ZZ - s^XX - s^YY|` of the examples.
const COMBINATION: f64 = 0.11;

/// Scale of `s` and `A` in the maps of single precession: so small that the error is due to the asymmetry alone.
const SINGLE_SCALE: f64 = 1e-4;

/// `A` of the examples of single precession.
const SINGLE_AMPLITUDE: f64 = 0.01;

/// Powers of ten of the error: the lightest and the darkest band, two bands per decade.
const ERRORS: (f64, f64) = (-4.5, 0.5);

/// A map: the error at each pair of the first and second parameter.
struct Map {
    table: Table,
    columns: usize,
    rows: usize,
}

pub(super) fn sheet() -> Result<Sheet, String> {
    let twofold = |form, name: &str| {
        map(name, "A [1/t_c]", POWERS, |beta_0, amplitude| {
            Case::paper(form, Precession::Twofold, SCALE, beta_0, amplitude)
                .errors(DURATION, 64)
                .map(|errors| errors.axis)
        })
    };
    let single = |form, name: &str| {
        let asymmetry = "|s^XX - s^YY| / |2 s^ZZ - s^XX - s^YY| [1]";
        map(name, asymmetry, ASYMMETRY_POWERS, |beta_0, asymmetry| single_error(form, beta_0, asymmetry))
    };
    let maps = [
        twofold(Form::Printed, "twofold-printed")?,
        twofold(Form::Corrected, "twofold-corrected")?,
        single(Form::Printed, "single-printed")?,
        single(Form::Corrected, "single-corrected")?,
    ];
    let svg = draw(&maps);
    Ok(Sheet { svg, caption: caption(), tables: maps.map(|map| map.table).to_vec() })
}

/// Largest distance of the axes over one forced period.
fn single_error(form: Form, beta_0: f64, asymmetry: f64) -> Result<f64, String> {
    let half = asymmetry * COMBINATION / 2.0;
    let s = PrincipalCoefficients::new([0.015 + half, 0.015 - half, -0.04]).scaled(SINGLE_SCALE);
    let amplitude = SINGLE_AMPLITUDE * SINGLE_SCALE;
    Case { form, kind: Precession::Single, s, beta_0, amplitude }.axis_error_over_forced_period(256)
}

fn map(
    name: &str,
    second: &str,
    powers: (f64, f64, usize),
    error: impl Fn(f64, f64) -> Result<f64, String>,
) -> Result<Map, String> {
    let at = |(low, high, steps): (f64, f64, usize), i: usize| low + (high - low) * i as f64 / (steps - 1) as f64;
    let mut table = Table::new(name, ["beta_0 [rad]", second, "error [rad]"]);
    for j in 0..powers.2 {
        for i in 0..INCLINATIONS.2 {
            let (beta_0, parameter) = (at(INCLINATIONS, i), 10f64.powf(at(powers, j)));
            table.push([beta_0, parameter, error(beta_0, parameter)?]);
        }
    }
    Ok(Map { table, columns: INCLINATIONS.2, rows: powers.2 })
}

/// Five colours of viridis, reversed: a small error is light, and the lightness decreases throughout, also in grey.
const COLOURS: [[f64; 3]; 5] =
    [[253.0, 231.0, 37.0], [94.0, 201.0, 98.0], [33.0, 145.0, 140.0], [59.0, 82.0, 139.0], [68.0, 1.0, 84.0]];

fn colour(part: f64) -> String {
    let place = part.clamp(0.0, 1.0) * 4.0;
    let i = (place as usize).min(3);
    let [r, g, b] =
        [0, 1, 2].map(|k| (COLOURS[i][k] + (COLOURS[i + 1][k] - COLOURS[i][k]) * (place - i as f64)).round());
    format!("#{:02x}{:02x}{:02x}", r as u8, g as u8, b as u8)
}

const BANDS: usize = 10;

fn draw(maps: &[Map; 4]) -> String {
    let (left, top, height, between, below) = (40.0, 18.0, 128.0, 52.0, BELOW + 18.0);
    let width = (PAGE - left - 52.0 - between) / 2.0;
    let grid = Grid { left, top, width, height, between: [between, below] };
    let mut page = Page::new("perturbation-regimes", PAGE, 2.0 * top + 2.0 * height + below + BELOW - top);
    let names = ["twofold, printed", "twofold, corrected", "single, printed", "single, corrected"];
    for (i, (map, what)) in maps.iter().zip(names).enumerate() {
        let frame = grid.frame(i % 2, i / 2);
        let (powers, label) = if i < 2 { (POWERS, "*A* *t*_{c}") } else { (ASYMMETRY_POWERS, "asymmetry of *s*") };
        let x = Axis::linear("*β*_{0} [rad]", INCLINATIONS.0, INCLINATIONS.1);
        let y = Axis::logarithmic(label, 10f64.powf(powers.0), 10f64.powf(powers.1));
        let mut panel = Panel::new(frame, x, y);
        panel.y_label_distance = 25.0;
        let values: Vec<f64> = map.table.rows.iter().map(|row| row[2].log10()).collect();
        let band = |value: f64| (value - ERRORS.0) / (ERRORS.1 - ERRORS.0) * BANDS as f64;
        for (cell, number) in
            bands(&values, map.columns, map.rows, |value| band(value).floor().clamp(0.0, 9.0) as usize)
        {
            let part = (number as f64 + 0.5) / BANDS as f64;
            let [u0, v0, u1, v1] = cell;
            let r = Rectangle {
                left: frame.left + u0 * frame.width,
                top: frame.bottom() - v1 * frame.height,
                width: (u1 - u0) * frame.width,
                height: (v1 - v0) * frame.height,
            };
            page.cell(r, &colour(part));
        }
        for power in [-4, -3, -2, -1] {
            for line in isoline(&values, map.columns, map.rows, f64::from(power)) {
                let points: Vec<_> = line
                    .iter()
                    .map(|[u, v]| [frame.left + u * frame.width, frame.bottom() - v * frame.height])
                    .collect();
                page.path(&points, solid(if power > -2 { "#ffffff" } else { BLACK }, 0.8));
            }
        }
        let examples: &[(f64, f64, &str)] = if i < 2 {
            &[(0.7, 0.4, "tp-II")]
        } else {
            &[(0.7, 0.01 / COMBINATION, "sp-I"), (1.4, 0.01 / COMBINATION, "sp-II")]
        };
        for &(beta_0, parameter, example) in examples {
            let at = panel.at(beta_0, parameter);
            draw_mark(&mut page, at, Mark::Ring, 2.2, BLACK);
            // The name is inside the frame, also near its right side.
            let aside = if beta_0 > 1.2 { -8.0 } else { 0.0 };
            page.name([at[0] + aside, at[1] + 10.0], BLACK, example);
        }
        panel.draw_frame(&mut page);
        panel.letter(&mut page, i, maps.len(), what);
    }
    scale(&mut page, PAGE - 38.0, top, height);
    scale(&mut page, PAGE - 38.0, top + height + below, height);
    page.finish("Error of the perturbation solutions")
}

fn scale(page: &mut Page, left: f64, top: f64, height: f64) {
    let step = height / BANDS as f64;
    for band in 0..BANDS {
        let r = Rectangle { left, top: top + height - step * (band + 1) as f64, width: 9.0, height: step };
        page.cell(r, &colour((band as f64 + 0.5) / BANDS as f64));
    }
    page.outline(Rectangle { left, top, width: 9.0, height }, solid(BLACK, 0.6));
    for power in -4..=0 {
        let y = top + height * (1.0 - (f64::from(power) - ERRORS.0) / (ERRORS.1 - ERRORS.0));
        page.path(&[[left + 6.5, y], [left + 9.0, y]], solid(BLACK, 0.6));
        page.text([left + 12.0, y + 0.35 * SMALL], Anchor::Start, SMALL, BLACK, &power_of_ten(power));
    }
    page.label([left + 4.5, top - 4.5], Anchor::Middle, "error [rad]");
}

fn caption() -> Caption {
    let of_single = [("combination", COMBINATION), ("amplitude", SINGLE_AMPLITUDE)];
    let numbers = [("duration", DURATION), ("scale", SCALE)].into_iter().chain(of_single);
    Caption::of("perturbation-regimes", &numbers.map(written).collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// At the values of the list, between them and beyond them.
    #[test]
    fn colours_go_from_light_to_dark() {
        for (part, expected) in [
            (-1.0, "#fde725"),
            (0.0, "#fde725"),
            (0.125, "#aed844"),
            (0.25, "#5ec962"),
            (0.5, "#21918c"),
            (0.75, "#3b528b"),
            (0.875, "#402a70"),
            (1.0, "#440154"),
            (1.5, "#440154"),
        ] {
            assert_eq!(colour(part), expected, "{part}");
        }
    }
}
