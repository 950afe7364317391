//! Roots of polynomials.

/// The root nearest to zero, between zero and `end`, of a polynomial (coefficients ascending) that is positive at zero;
/// `end` if rounding hides the change of sign that must be there.
pub(crate) fn first_root(p: &[f64], end: f64) -> f64 {
    roots_between(p, end).first().copied().unwrap_or(end)
}

/// Roots at which the polynomial changes sign between zero and `end`, in the order from zero.
fn roots_between(p: &[f64], end: f64) -> Vec<f64> {
    if p.len() < 2 {
        return Vec::new();
    }
    let slope: Vec<f64> = p.iter().enumerate().skip(1).map(|(i, c)| c * i as f64).collect();
    let mut ends = vec![0.0];
    ends.extend(roots_between(&slope, end));
    ends.push(end);
    ends.windows(2).filter_map(|w| root_where_monotone(p, &slope, w[0], w[1])).collect()
}

/// The root between `a` and `b`, if the signs there differ: Newton's method restricted to the shrinking bracket.
fn root_where_monotone(p: &[f64], slope: &[f64], mut a: f64, mut b: f64) -> Option<f64> {
    let at = |p: &[f64], v: f64| p.iter().rev().fold(0.0, |sum, c| sum * v + c);
    let positive_at_a = at(p, a) > 0.0;
    if positive_at_a == (at(p, b) > 0.0) {
        return None;
    }
    let mut v = 0.5 * (a + b);
    // Bisection alone needs up to 1100 steps to a root next to zero; with Newton's steps a few suffice.
    for _ in 0..1200 {
        let value = at(p, v);
        if (value > 0.0) == positive_at_a {
            a = v;
        } else {
            b = v;
        }
        let newton = v - value / at(slope, v);
        let next = if (newton - a) * (newton - b) < 0.0 { newton } else { 0.5 * (a + b) };
        if (next - v).abs() <= f64::EPSILON * v.abs() {
            break;
        }
        v = next;
    }
    Some(v)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Roots are accurate to their own rounding, however small they are: `(1 - v / r) (2 - v) (3 + v)`.
    #[test]
    fn small_roots_have_all_digits() {
        for root in [1e-3, 1e-9, 1e-15, -1e-9, -1e-15, 0.7] {
            let p = [6.0, -1.0 - 6.0 / root, 1.0 / root - 1.0, 1.0 / root];
            let found = first_root(&p, if root > 0.0 { 1.0 } else { -1.0 });
            assert!((found / root - 1.0).abs() < 1e-14, "{root:e}: {found:e}");
        }
    }

    /// `(v - 1) (v - 2) (v + 3)`, positive at zero.
    #[test]
    fn roots_come_in_the_order_from_zero() {
        let p = [6.0, -7.0, 0.0, 1.0];
        for (end, expected) in [(5.0, vec![1.0, 2.0]), (1.5, vec![1.0]), (-4.0, vec![-3.0]), (0.5, vec![])] {
            let found = roots_between(&p, end);
            assert_eq!(found.len(), expected.len());
            assert!(found.iter().zip(&expected).all(|(found, root)| (found - root).abs() < 1e-15), "{found:?}");
            assert_eq!(first_root(&p, end), found.first().copied().unwrap_or(end));
        }
    }
}
