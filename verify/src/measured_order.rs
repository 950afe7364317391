//! The order of an error in a small parameter, as the measured value of a check.

use crate::prelude::*;
use twofold::numerics::straight_line::order;

/// Errors at some values of a parameter, as points for [`measured_order`].
pub(crate) fn errors_at(
    parameters: impl IntoIterator<Item = f64>,
    mut error: impl FnMut(f64) -> Result<f64, String>,
) -> Result<Vec<(f64, f64)>, String> {
    parameters.into_iter().map(|x| Ok((x, error(x)?))).collect()
}

/// [`measured_order`] of the errors at some values of the parameter, none of which is rounding.
pub(crate) fn order_of_error(
    parameters: &[f64],
    error: impl Fn(f64) -> Result<f64, String>,
) -> Result<Measured, String> {
    measured_order(&errors_at(parameters.iter().copied(), error)?, 0.0)
}

/// Slope of a least-squares line through the logarithms of `points` without errors below `floor`, with its uncertainty and the points.
pub(crate) fn measured_order(points: &[(f64, f64)], floor: f64) -> Result<Measured, String> {
    let slope = order(points, floor)?;
    let listed: Vec<_> = points.iter().map(|(x, y)| format!("{x:.1e}: {y:.2e}")).collect();
    Ok(Measured::new(slope.value, format!("+- {:.4}; {}", slope.error, listed.join(", "))))
}

/// The largest difference between a measured and the expected order, for several errors, each given by name, expected order and points.
pub(crate) fn largest_off_order<N: std::fmt::Display>(
    errors: impl IntoIterator<Item = (N, f64, Vec<(f64, f64)>)>,
) -> Result<Measured, String> {
    let mut worst = Worst::default();
    for (name, expected, points) in errors {
        let Measured { figure, detail } = measured_order(&points, 0.0)?;
        worst.see((figure - expected).abs(), || format!("{name}: {figure:.4} {detail}"));
    }
    worst.finish()
}
