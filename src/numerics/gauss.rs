//! Gaussian quadrature.

use core::num::NonZeroUsize;

use gauss_quad::GaussLegendre;

/// Gauss-Legendre nodes and weights on [0, 1], exact for polynomials of degree up to twice their number less one.
///
/// The nodes come from the crate `gauss-quad` (Bogaert's expansions, accurate to rounding for any number of nodes): it is
/// maintained, and without its default features it depends only on `nalgebra`, which is used here already.
pub(crate) fn unit_rule(nodes: NonZeroUsize) -> Vec<(f64, f64)> {
    GaussLegendre::new(nodes).iter().map(|&(x, w)| (0.5 * (x + 1.0), 0.5 * w)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_below_twice_the_number_of_nodes_are_exact() {
        for nodes in [1, 16, 20, 28] {
            let rule = unit_rule(NonZeroUsize::new(nodes).unwrap());
            assert_eq!(rule.len(), nodes);
            for power in [0, 1, nodes as i32, 2 * nodes as i32 - 1] {
                let integral: f64 = rule.iter().map(|(t, w)| w * t.powi(power)).sum();
                assert!((integral * f64::from(power + 1) - 1.0).abs() < 1e-13, "{nodes} {power}");
            }
        }
    }
}
