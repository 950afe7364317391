//! The order of an error, as the figure of a check.

use twofold::straight_line::order;

use crate::check::Measured;

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
