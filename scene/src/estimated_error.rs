//! Estimated errors for printing.

/// Rounding of a component of a direction, or of `L` in units of its size, when printed as a double.
pub const ROUNDING_OF_COMPONENT: f64 = 0.5 * f64::EPSILON;

/// An estimated error of numbers rounded by `rounding`: the larger of the two. NaN stays NaN.
pub fn as_printed(error: f64, rounding: f64) -> f64 {
    if error < rounding { rounding } else { error }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_below_the_rounding_of_what_is_printed_is_that_rounding() {
        for (error, printed) in [(0.0, 9e-12), (2.1e-36, 9e-12), (1e-11, 1e-11), (f64::INFINITY, f64::INFINITY)] {
            assert_eq!(as_printed(error, 9e-12), printed);
        }
        assert!(as_printed(f64::NAN, 9e-12).is_nan());
    }

    /// One plus a small number is rounded to one up to half of the distance to the next double, and to that double beyond.
    #[test]
    fn the_rounding_of_a_component_is_the_most_that_a_sum_beside_one_loses() {
        assert_eq!(1.0 + ROUNDING_OF_COMPONENT, 1.0);
        assert_eq!(1.0 + ROUNDING_OF_COMPONENT.next_up(), 1.0_f64.next_up());
    }
}
