//! Real roots of a polynomial on an interval.

fn value(coefficients: &[f64], x: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c)
}

/// Roots in a range, with its ends, of `c[0] + c[1] x + ...`, in order, and the points between them where its size has a minimum without a change of
/// sign: a double root is among these, whatever rounding does to it.
pub(super) fn roots_and_touches(coefficients: &[f64], range: (f64, f64)) -> Vec<f64> {
    let slope: Vec<f64> = coefficients.iter().enumerate().skip(1).map(|(i, c)| c * i as f64).collect();
    // The polynomial has an extremum where its slope changes sign; between two such points it has at most one root.
    let mut roots = if slope.len() > 1 { roots_and_touches(&slope, range) } else { vec![range.0, range.1] };
    for pair in roots.clone().windows(2) {
        let (mut left, mut right) = (pair[0], pair[1]);
        let (first, last) = (value(coefficients, left), value(coefficients, right));
        // Not from their product, which may underflow.
        if first == 0.0 || last == 0.0 || (first > 0.0) == (last > 0.0) {
            continue;
        }
        loop {
            let middle = 0.5 * (left + right);
            if middle <= left || middle >= right {
                break;
            }
            if (value(coefficients, middle) > 0.0) == (first > 0.0) { left = middle } else { right = middle }
        }
        roots.push(0.5 * (left + right));
    }
    roots.sort_by(f64::total_cmp);
    roots
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    /// Coefficients of the product of `x - root`.
    fn with_roots(roots: &[f64]) -> Vec<f64> {
        roots.iter().fold(vec![1.0], |product, root| {
            let mut next = vec![0.0; product.len() + 1];
            for (i, c) in product.iter().enumerate() {
                next[i + 1] += c;
                next[i] -= root * c;
            }
            next
        })
    }

    /// A root at an end is a single point, and without a change of sign there is no root.
    #[test]
    fn no_root_is_told_twice() {
        let found = |coefficients: &[f64], low: f64, high: f64| roots_and_touches(coefficients, (low, high));
        assert_eq!(found(&[0.0, 1.0], -1.0, 0.0), [-1.0, 0.0]);
        assert_eq!(found(&[0.0, -1.0], -1.0, 0.0), [-1.0, 0.0]);
        assert_eq!(found(&[0.0, 1.0], 0.0, 1.0), [0.0, 1.0]);
        assert_eq!(found(&[0.5, 0.1], -1.0, 1.0), [-1.0, 1.0]);
        assert_eq!(found(&[-0.5, 0.1], -1.0, 1.0), [-1.0, 1.0]);
        assert_eq!(found(&[-0.5, 1.0], -1.0, 1.0), [-1.0, 0.5, 1.0]);
        assert_eq!(found(&[1.0, -2.0], -1.0, 1.0), [-1.0, 0.5, 1.0]);
        // For any size.
        for size in [1e-200, 1e200] {
            assert_eq!(found(&[-0.5 * size, size], -1.0, 1.0), [-1.0, 0.5, 1.0]);
        }
        assert_eq!(found(&[0.125, -0.5, 1.0], -1.0, 1.0), [-1.0, 0.25, 1.0]);
    }

    #[test]
    fn all_roots_within_and_none_without_are_found() {
        for roots in [
            vec![-0.9, -0.3, 0.2, 0.7],
            vec![-0.5, 1e-3, 1.5, 2.0],
            vec![-1e-7, 0.4, 0.4, 0.4],
            vec![0.1, 0.2, 0.3],
            vec![-3.0, -2.0, 4.0, 5.0],
        ] {
            let polynomial = with_roots(&roots);
            let found = roots_and_touches(&polynomial, (-1.0, 1.0));
            assert!(found.is_sorted() && found.iter().all(|x| (-1.0..=1.0).contains(x)));
            for (i, root) in roots.iter().enumerate().filter(|(_, root)| root.abs() <= 1.0) {
                let nearest = found
                    .iter()
                    .fold(f64::INFINITY, |best, x| if (x - root).abs() < (best - root).abs() { *x } else { best });
                // A triple root is known to the cube root of rounding.
                let allowed = if roots.iter().filter(|other| *other == root).count() > 1 {
                    1e-5
                } else {
                    1e-14 * root.abs().max(1e-3)
                };
                assert!((nearest - root).abs() <= allowed, "{roots:?}, {i}: {nearest}");
            }
        }
        // As close together as doubles can be, also far from one.
        for root in [3e-5, -3e-5, 0.7, -0.7] {
            let found = roots_and_touches(&[-root, 1.0], (-0.9, 1.0))[1];
            assert_relative_eq!(found, root, max_relative = 3e-16);
        }
    }
}
