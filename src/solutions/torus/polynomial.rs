//! Real roots of a polynomial on an interval.

fn value(coefficients: &[f64], x: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c)
}

/// Roots in `[low, high]` of `c[0] + c[1] x + ...`, in order, and the places between where it is least in size without a change of sign: a
/// double root is among these, whatever rounding made of it.
pub(super) fn roots_and_touches(coefficients: &[f64], low: f64, high: f64) -> Vec<f64> {
    let slope: Vec<f64> = coefficients.iter().enumerate().skip(1).map(|(i, c)| c * i as f64).collect();
    let mut places = vec![low];
    if slope.len() > 1 {
        // Where the slope changes its sign the polynomial turns; between two such places it has one root at most.
        places.extend(roots_and_touches(&slope, low, high));
    }
    places.push(high);
    let mut roots = places.clone();
    for pair in places.windows(2) {
        let (mut left, mut right) = (pair[0], pair[1]);
        let sign = value(coefficients, left).signum();
        if sign * value(coefficients, right) >= 0.0 {
            continue;
        }
        while right - left > f64::EPSILON * left.abs().max(right.abs()) {
            let middle = 0.5 * (left + right);
            if middle <= left || middle >= right {
                break;
            }
            if sign * value(coefficients, middle) > 0.0 { left = middle } else { right = middle }
        }
        roots.push(0.5 * (left + right));
    }
    roots.sort_by(f64::total_cmp);
    roots
}
