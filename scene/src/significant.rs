//! Numbers for reading, with a given number of significant digits.

use std::ops::RangeInclusive;

/// `x` with a given number of significant digits: as a decimal if the power of ten of the first digit is in `decimals`,
/// otherwise as mantissa and power.
pub fn rounded(x: f64, digits: usize, decimals: RangeInclusive<i32>) -> (String, Option<i32>) {
    if x == 0.0 {
        return ("0".to_owned(), None);
    }
    let text = format!("{x:.*e}", digits.max(1) - 1);
    // Computed from the rounded number: 9.99 with one digit is 10.
    let Some((mantissa, power)) = text.split_once('e') else { return (text, None) };
    match power.parse() {
        Ok(power) if decimals.contains(&power) => {
            let places = (digits as i32 - 1 - power).max(0);
            (format!("{:.*}", places as usize, text.parse::<f64>().unwrap_or(x)), None)
        }
        power => (mantissa.to_owned(), power.ok()),
    }
}

/// `x` with `digits` significant digits, as a decimal from 1e-4 to below 1e6 in size and otherwise with an exponent.
pub fn significant(x: f64, digits: usize) -> String {
    match rounded(x, digits, -4..=5) {
        (text, None) => text,
        (mantissa, Some(power)) => format!("{mantissa}e{power}"),
    }
}

#[cfg(test)]
mod tests {
    use super::significant;

    #[test]
    fn digits_are_counted_and_extremes_have_exponents() {
        for (x, digits, text) in [
            (0.1, 10, "0.1000000000"),
            (-std::f64::consts::FRAC_PI_2, 10, "-1.570796327"),
            (1e-10, 10, "1.000000000e-10"),
            (-1e-10, 3, "-1.00e-10"),
            (0.0, 10, "0"),
            (-0.0, 10, "0"),
            (1.2345e-4, 3, "0.000123"),
            (9.9996e-5, 3, "0.000100"),
            (9.994e-5, 3, "9.99e-5"),
            (999_999.4, 6, "999999"),
            (999_999.6, 6, "1.00000e6"),
            (123_456.0, 3, "123000"),
            (9.99, 1, "10"),
            (1.797e308, 2, "1.8e308"),
            (5e-324, 2, "4.9e-324"),
            (f64::INFINITY, 3, "inf"),
        ] {
            assert_eq!(significant(x, digits), text, "{x:e} with {digits}");
        }
        assert_eq!(significant(f64::NAN, 4), "NaN");
    }
}
