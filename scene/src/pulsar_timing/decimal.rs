//! Unevaluated sums of two doubles as decimal text.

/// `x[0] + x[1]` with 24 decimals, for sums up to 1e13 in size.
pub fn decimal(x: [f64; 2]) -> String {
    const DECIMALS: usize = 24;
    // Each part becomes a whole number in units of its last decimal. The decimal expansion is exact for multiples of 2^-24.
    let scaled = |part: f64| format!("{part:.DECIMALS$}").replace('.', "").parse::<i128>().unwrap_or_default();
    let sum = scaled(x[0]) + scaled(x[1]);
    let (sign, digits) =
        (if sum < 0 { "-" } else { "" }, format!("{:0>width$}", sum.unsigned_abs(), width = DECIMALS + 1));
    let (whole, fraction) = digits.split_at(digits.len() - DECIMALS);
    format!("{sign}{whole}.{fraction}")
}

#[cfg(test)]
mod tests {
    use super::decimal;

    #[test]
    fn both_parts_are_written() {
        assert_eq!(decimal([641.5, 1e-20]), "641.500000000000000000010000");
        assert_eq!(decimal([641.5, -1e-20]), "641.499999999999999999990000");
        assert_eq!(decimal([0.0, 0.0]), "0.000000000000000000000000");
        assert_eq!(decimal([-0.25, 0.0]), "-0.250000000000000000000000");
        assert_eq!(decimal([0.0, -1e-24]), "-0.000000000000000000000001");
    }
}
