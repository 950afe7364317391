//! Draws the picture of the README: `cargo run --release -p twofold-tools --bin readme_picture`.
//!
//! Left, a small tilt of the angular momentum without Lorentz violation: numerical motion and perturbation solutions from the
//! same initial values. Right, the error of the printed and of the corrected perturbation solution for tp-I as the
//! coefficients for Lorentz violation are scaled.

use std::error::Error;

use plotters::coord::Shift;
use plotters::coord::combinators::IntoLogRange;
use plotters::prelude::*;
use twofold::propagation::Motion;
use twofold::solutions::perturbation::{Form, Precession};
use twofold_verify::checks::regimes::perturbation_error::Case;

// Okabe and Ito's colours, told apart by readers who see red and green alike.
const NUMERICAL: RGBColor = RGBColor(170, 170, 170);
const PRINTED: RGBColor = RGBColor(213, 94, 0);
const CORRECTED: RGBColor = RGBColor(0, 114, 178);

/// Plotters rounds to whole units of the drawing: a large drawing keeps curves smooth.
const UNIT: u32 = 4;

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

fn main() -> Result<(), Box<dyn Error>> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/images/perturbation.svg");
    let root = SVGBackend::new(path, (1040 * UNIT, 400 * UNIT)).into_drawing_area();
    root.fill(&WHITE)?;
    let (left, right) = root.split_horizontally(520 * UNIT);
    inclination(&left)?;
    errors(&right)?;
    root.present()?;
    Ok(())
}

fn inclination(area: &Area) -> Result<(), Box<dyn Error>> {
    let duration = 20.0;
    let tilt = 0.01;
    // The same tilt by both: A / omega as printed, A / a corrected. Too small an s to matter, since a^(1) needs a sign.
    let case = |form, frequency: f64| Case::paper(form, Precession::Twofold, 1e-40, 0.7, tilt * frequency);
    let printed = case(Form::Printed, 1.1);
    let corrected = case(Form::Corrected, 1.1 / 0.7f64.cos());
    let motion = printed.motion(duration)?;
    let times: Vec<f64> = (0..=600).map(|i| duration * f64::from(i) / 600.0).collect();
    let numerical =
        times.iter().map(|&t| motion.state(t).map(|s| (t, s.axis.z.acos()))).collect::<Result<Vec<_>, _>>()?;

    let mut chart = ChartBuilder::on(area)
        .margin(14 * UNIT)
        .x_label_area_size(44 * UNIT)
        .y_label_area_size(66 * UNIT)
        .caption("free precession, angular momentum tilted by 0.01", ("sans-serif", 18 * UNIT))
        .build_cartesian_2d(0.0..duration, 0.685..0.725)?;
    chart
        .configure_mesh()
        .light_line_style(WHITE.mix(0.0))
        .bold_line_style(BLACK.mix(0.08))
        .x_label_formatter(&|v| format!("{v:.0}"))
        .x_desc("t / t_c")
        .y_desc("β [rad]")
        .y_label_formatter(&|v| format!("{v:.3}"))
        .label_style(("sans-serif", 15 * UNIT))
        .axis_desc_style(("sans-serif", 16 * UNIT))
        .draw()?;
    chart
        .draw_series(LineSeries::new(numerical, NUMERICAL.stroke_width(5 * UNIT)))?
        .label("numerical")
        .legend(|(x, y)| PathElement::new([(x, y), (x + 22 * UNIT as i32, y)], NUMERICAL.stroke_width(5 * UNIT)));
    let curve = |case: &Case| -> Result<Vec<(f64, f64)>, String> {
        let solution = case.solution()?;
        Ok(times.iter().map(|&t| (t, solution.at(t).beta)).collect())
    };
    chart
        .draw_series(DashedLineSeries::new(curve(&printed)?, 7 * UNIT, 4 * UNIT, PRINTED.stroke_width(2 * UNIT)))?
        .label("perturbation, as printed")
        .legend(|(x, y)| PathElement::new([(x, y), (x + 22 * UNIT as i32, y)], PRINTED.stroke_width(2 * UNIT)));
    chart
        .draw_series(DashedLineSeries::new(curve(&corrected)?, 2 * UNIT, 4 * UNIT, CORRECTED.stroke_width(2 * UNIT)))?
        .label("perturbation, corrected")
        .legend(|(x, y)| PathElement::new([(x, y), (x + 22 * UNIT as i32, y)], CORRECTED.stroke_width(2 * UNIT)));
    legend(&mut chart, SeriesLabelPosition::UpperRight)
}

fn errors(area: &Area) -> Result<(), Box<dyn Error>> {
    let scales: Vec<f64> = (0..=24).map(|j| 10f64.powf(-0.25 * f64::from(j))).collect();
    let mut chart = ChartBuilder::on(area)
        .margin(14 * UNIT)
        .x_label_area_size(44 * UNIT)
        .y_label_area_size(66 * UNIT)
        .caption("tp-I with s scaled: largest error of β over 10 t_c", ("sans-serif", 18 * UNIT))
        .build_cartesian_2d((1e-6..1.0).log_scale(), (1e-15..1e-1).log_scale())?;
    chart
        .configure_mesh()
        .light_line_style(WHITE.mix(0.0))
        .bold_line_style(BLACK.mix(0.08))
        .x_desc("scale of s")
        .y_desc("error [rad]")
        .x_label_formatter(&|v| power_of_ten(*v))
        .y_label_formatter(&|v| power_of_ten(*v))
        .label_style(("sans-serif", 15 * UNIT))
        .axis_desc_style(("sans-serif", 16 * UNIT))
        .draw()?;
    let forms = [(Form::Printed, PRINTED, "as printed: order 1"), (Form::Corrected, CORRECTED, "corrected: order 2")];
    for (form, colour, label) in forms {
        let points = scales
            .iter()
            .map(|&k| Ok((k, Case::paper(form, Precession::Twofold, k, 0.7, 0.0).errors(10.0, 400)?.beta)))
            .collect::<Result<Vec<_>, String>>()?;
        chart
            .draw_series(LineSeries::new(points.clone(), colour.stroke_width(2 * UNIT)))?
            .label(label)
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 22 * UNIT as i32, y)], colour.stroke_width(2 * UNIT)));
        chart.draw_series(points.into_iter().map(|point| Circle::new(point, 3 * UNIT, colour.filled())))?;
    }
    legend(&mut chart, SeriesLabelPosition::UpperLeft)
}

fn legend<'a, 'b: 'a, C: CoordTranslate + 'a>(
    chart: &mut ChartContext<'a, SVGBackend<'b>, C>,
    position: SeriesLabelPosition,
) -> Result<(), Box<dyn Error>> {
    chart
        .configure_series_labels()
        .legend_area_size(30 * UNIT)
        .margin(8 * UNIT)
        .position(position)
        .background_style(WHITE.mix(0.9))
        .border_style(BLACK.mix(0.3))
        .label_font(("sans-serif", 15 * UNIT))
        .draw()?;
    Ok(())
}

fn power_of_ten(value: f64) -> String {
    format!("1e{:.0}", value.log10())
}
