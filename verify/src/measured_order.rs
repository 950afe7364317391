//! The order of an error in a small parameter, as the figure of a check.

use twofold::straight_line::order;

use crate::check::Measured;

/// [`measured_order`] of the errors at some values of the parameter, none of them rounding.
///
/// # Errors
/// A value without an error; too few of them.
pub fn order_of_error(parameters: &[f64], error: impl Fn(f64) -> Result<f64, String>) -> Result<Measured, String> {
    let points = parameters.iter().map(|&x| Ok((x, error(x)?))).collect::<Result<Vec<_>, String>>()?;
    measured_order(&points, 0.0)
}

/// Slope of a least-squares line through the logarithms of `points`, errors below `floor` left out, with its uncertainty and the points
/// behind it.
///
/// # Errors
/// If too few points are left.
pub fn measured_order(points: &[(f64, f64)], floor: f64) -> Result<Measured, String> {
    let slope = order(points, floor)?;
    let listed: Vec<_> = points.iter().map(|(x, y)| format!("{x:.1e}: {y:.2e}")).collect();
    Ok(Measured::new(slope.value, format!("+- {:.4}; {}", slope.error, listed.join(", "))))
}
