//! Initial values printed in the captions of the paper, compared with its formulas.

use crate::prelude::*;

/// Whether `value`, rounded to the digits of `text`, equals `text`. In powers of ten (`2.1e-3`) the digits of the mantissa count.
pub fn rounds_to(value: f64, text: &str) -> bool {
    let printed: f64 = text.parse().expect("printed numbers are numbers");
    let (mantissa, exponent) = text.split_once('e').unwrap_or((text, "0"));
    let decimals = mantissa.split_once('.').map_or(0, |(_, digits)| digits.len() as i32);
    let exponent: i32 = exponent.parse().expect("an exponent");
    let half_unit = 0.5 * 10f64.powi(exponent - decimals);
    (value - printed).abs() <= half_unit * (1.0 + 1e-9)
}

/// Initial values of the four examples: name, printed value (pi/2 as 1.5707963), and value by Eq. (34).
pub(crate) fn caption_values() -> Result<Vec<(String, &'static str, f64)>, Error> {
    let captions = [
        ["1.5707963", "0.701", "1.509", "0"],
        ["1.5707963", "1.065", "0.889", "0"],
        ["1.5707963", "0.671", "-0.068", "0"],
        ["1.5707963", "1.146", "-0.008", "0"],
    ];
    let names = ["alpha [rad]", "beta [rad]", "alpha rate [1/t_c]", "beta rate [1/t_c]"];
    let mut values = Vec::new();
    for (example, caption) in paper_examples().iter().zip(captions) {
        let q = example.initial_values()?;
        for ((name, printed), ours) in names.iter().zip(caption).zip([q.alpha, q.beta, q.alpha_rate, q.beta_rate]) {
            values.push((format!("{} {name} at t = 0", example.name), printed, ours));
        }
    }
    Ok(values)
}
