//! The factor `eta` of Eq. (41) against the inclination.

use super::drawing::*;
use twofold_verify::eta::{PAPER_ASYMMETRY, eta_curve};

const NAME: &str = "bound-factor";

/// Inclinations of the curve (rad); at pi/2 the paper's estimate divides by zero.
const INCLINATIONS: (f64, f64, usize) = (0.05, 1.565, 120);

/// The largest value according to the paper.
const CONSERVATIVE: f64 = 10.0;

const PRINTED: Line = dashed(VERMILION, 1.2);
const ROOT_MEAN_SQUARE: Line = solid(BLACK, 1.5);
const MEDIAN: Line = dash_dotted(BLUE, 0.9);
const HIGH: Line = dotted(BLUE, 1.1);
const AXISYMMETRIC: Line = solid(GREY, 0.8);

pub(super) fn sheet() -> Result<Sheet, String> {
    let (from, to, steps) = INCLINATIONS;
    let inclinations: Vec<_> = (0..=steps).map(|i| from + (to - from) * i as f64 / steps as f64).collect();
    let curve = |ratio| eta_curve(ratio, &inclinations).map_err(|error| error.to_string());
    let columns = [
        "beta_0 [rad]",
        "1/cos beta_0 [1]",
        "eta [1]",
        "eta at this inclination: median [1]",
        "eta at this inclination: 97.5 % [1]",
        "eta for s^XX = s^YY [1]",
    ];
    let mut table = Table::new("", columns);
    for (paper, axisymmetric) in curve(PAPER_ASYMMETRY)?.iter().zip(curve(0.0)?) {
        let at = paper.at_inclination;
        table.push([
            paper.beta_0,
            paper.printed,
            paper.along_motion,
            at.median,
            at.quantile_975,
            axisymmetric.along_motion,
        ]);
    }
    Ok(Sheet { svg: draw(&table), caption: caption(&table), tables: vec![table] })
}

fn draw(table: &Table) -> String {
    let (top, height) = (10.0, 150.0);
    let mut page = Page::new(NAME, COLUMN, top + height + BELOW + 42.0);
    let frame = Rectangle { left: LEFT - 4.0, top, width: COLUMN - LEFT - 4.0, height };
    let mut panel = Panel::new(frame, Axis::linear("*β*_{0} [rad]", 0.0, 1.6), Axis::logarithmic("*η*", 1.0, 1000.0));
    panel.y_label_distance = 24.0;
    panel.level(&mut page, CONSERVATIVE, solid("#c8c8c8", 0.8));
    for (column, line) in [(5, AXISYMMETRIC), (3, MEDIAN), (4, HIGH), (1, PRINTED), (2, ROOT_MEAN_SQUARE)] {
        panel.curve(&mut page, &table.points(0, column), line);
    }
    panel.draw_frame(&mut page);
    let below = top + height + BELOW + 8.0;
    let left = [
        (Sample::Line(ROOT_MEAN_SQUARE), "root mean square"),
        (Sample::Line(MEDIAN), "median"),
        (Sample::Line(HIGH), "97.5 %"),
    ];
    legend(&mut page, [LEFT - 4.0, below], &left);
    let right = [(Sample::Line(PRINTED), "1/cos *β*_{0}"), (Sample::Line(AXISYMMETRIC), "*s*^{*XX*} = *s*^{*YY*}")];
    legend(&mut page, [LEFT + 104.0, below], &right);
    page.finish("Factor eta against the inclination")
}

fn caption(table: &Table) -> Caption {
    let near = |beta: f64| table.rows.iter().min_by(|a, b| (a[0] - beta).abs().total_cmp(&(b[0] - beta).abs()));
    let at = |beta: f64| {
        near(beta).map_or(String::new(), |row| {
            format!("{:.1} at *β*_{{0}} = {:.2}, where 1/cos *β*_{{0}} is {:.1}", row[2], row[0], row[1])
        })
    };
    Caption::of("bound-factor", &[("small", at(0.2)), ("large", at(1.4))])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// At the rows nearest to 0.2 and to 1.4, in any order of the rows.
    #[test]
    fn a_caption_tells_the_factor_at_two_inclinations() {
        let mut table = Table::new("", ["beta_0", "1/cos", "eta", "median", "97.5 %", "axisymmetric"]);
        for (beta, eta) in [(1.5, 8.0), (1.46, 7.0), (1.37, 6.34), (0.9, 3.0), (0.23, 4.36), (0.14, 7.04), (0.01, 99.0)]
        {
            table.push([beta, f64::cos(beta).recip(), eta, 1.0, 2.0, 3.0]);
        }
        let says = caption(&table).says;
        for told in [
            "moves little: 4.4 at *β*_{0} = 0.23, where 1/cos *β*_{0} is 1.0.",
            "(6.3 at *β*_{0} = 1.37, where 1/cos *β*_{0} is 5.0)",
        ] {
            assert!(says.contains(told), "{told}, but {says}");
        }
    }

    /// For `s^XX = s^YY` the axis moves on a circle about Z, and `eta = sqrt(3) / (sin b cos b)`.
    #[test]
    fn the_axisymmetric_factor_is_that_of_a_circle() {
        for row in &sheet().unwrap().tables[0].rows {
            let expected = 3.0_f64.sqrt() / (row[0].sin() * row[0].cos().abs());
            assert!((row[5] / expected - 1.0).abs() < 1e-9, "{}: {} for {expected}", row[0], row[5]);
        }
    }
}
