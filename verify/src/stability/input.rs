//! The ranges from which the inputs of a case are drawn.

use crate::prelude::*;

/// The range of one input.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Input {
    /// This number.
    Fixed(f64),
    /// Uniform between two numbers.
    In(f64, f64),
    /// `10^u` with `u` uniform between two numbers.
    Log(f64, f64),
    /// The same with either sign.
    Signed(f64, f64),
    /// A number at the distance `10^u` from the first one, above or below.
    Near(f64, f64, f64),
    /// The same, below only.
    Below(f64, f64, f64),
    /// The same, above only.
    Above(f64, f64, f64),
}

impl Input {
    /// A number of the range, at the fraction `share` of it.
    fn at(self, share: f64, random: &mut Random) -> f64 {
        let power = |low: f64, high: f64| 10f64.powf(low + (high - low) * share);
        let sign = if random.word() & 1 == 0 { 1.0 } else { -1.0 };
        match self {
            Input::Fixed(value) => value,
            Input::In(low, high) => low + (high - low) * share,
            Input::Log(low, high) => power(low, high),
            Input::Signed(low, high) => power(low, high) * sign,
            Input::Near(centre, low, high) => centre + power(low, high) * sign,
            Input::Below(centre, low, high) => centre - power(low, high),
            Input::Above(centre, low, high) => centre + power(low, high),
        }
    }
}

/// Points of a case: the first input at random in each of equal parts of its range, the others at random.
pub(super) fn points(inputs: &[Input], seed: u64, count: usize) -> impl Iterator<Item = Vec<f64>> {
    let mut random = Random::with_seed(seed);
    (0..count).map(move |i| {
        let mut draw = |n: usize, input: &Input| {
            let random_share = random.within(0.0, 1.0);
            let share = if n == 0 { (i as f64 + random_share) / count as f64 } else { random_share };
            input.at(share, &mut random)
        };
        inputs.iter().enumerate().map(|(n, input)| draw(n, input)).collect()
    })
}
