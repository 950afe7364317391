//! Weighted averages over a span of a numerical motion: mean rates of angles and single lines, for comparison with the exact ones.

use std::f64::consts::TAU;

use twofold::Error;
use twofold::dynamics::BodyState;
use twofold::propagation::Motion;

/// Weights of a mean at the middles of `count` cells: Kaiser's window `I_0(shape sqrt(1 - u^2))`, `u` from -1 to 1, with a mean of one. An
/// oscillation of frequency `f` contributes at most `1 / (sinh(shape) sqrt((f T / (2 shape))^2 - 1))` of its size, for `f T > 2 shape`.
pub(crate) fn kaiser(count: usize, shape: f64) -> Vec<f64> {
    let weight = |j: usize| {
        let x = (j as f64 + 0.5) / count as f64;
        bessel_i0(shape * 2.0 * (x * (1.0 - x)).sqrt())
    };
    let weights: Vec<f64> = (0..count).map(weight).collect();
    let mean = weights.iter().sum::<f64>() / count as f64;
    weights.into_iter().map(|weight| weight / mean).collect()
}

/// `I_0(x) = sum_k ((x/2)^k / k!)^2`; all terms are positive.
fn bessel_i0(x: f64) -> f64 {
    let quarter = x * x / 4.0;
    let (mut term, mut sum) = (1.0, 1.0);
    for k in 1.. {
        term *= quarter / f64::from(k * k);
        if sum + term == sum {
            break;
        }
        sum += term;
    }
    sum
}

/// Mean rate of a continuous angle given in equal steps of time, under a Kaiser window of shape 30: the leakage of an oscillation of frequency `f` is
/// below `1.2e-12` of its size if the series is longer than `60.3 / f`.
pub(crate) fn mean_rate(angles: &[f64], step: f64) -> f64 {
    let intervals = angles.len() - 1;
    // Relative to the secant, which is large and would cost digits.
    let secant = (angles[intervals] - angles[0]) / intervals as f64;
    let weights = kaiser(intervals, 30.0);
    let excess: f64 = weights.iter().zip(angles.windows(2)).map(|(w, pair)| w * (pair[1] - pair[0] - secant)).sum();
    (secant + excess / intervals as f64) / step
}

/// Mean rate of an angle of a motion that is known up to whole turns, from `samples` steps over `duration`.
pub(crate) fn mean_rate_of(
    motion: &impl Motion<f64, State = BodyState<f64>>,
    duration: f64,
    samples: usize,
    angle: impl Fn(&BodyState<f64>) -> Result<f64, Error>,
) -> Result<f64, Error> {
    let step = duration / samples as f64;
    let mut angles: Vec<f64> = Vec::with_capacity(samples + 1);
    for i in 0..=samples {
        let next = angle(&motion.state((step * i as f64).min(duration))?)?;
        let last = angles.last().copied().unwrap_or(next);
        angles.push(next + ((last - next) / TAU).round() * TAU);
    }
    Ok(mean_rate(&angles, step))
}

/// The azimuth of `L` about Z.
pub(crate) fn azimuth_of_momentum(state: &BodyState<f64>) -> Result<f64, Error> {
    Ok(state.momentum.y.atan2(state.momentum.x))
}
