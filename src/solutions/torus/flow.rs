//! Flows of the integrals, by Taylor series.

use nalgebra::Vector3;

use crate::dynamics::RigidSpheroid;
use crate::numerics::scalar::{Real, length};

/// Order of the series.
const ORDER: usize = 26;

/// Accuracy of a step.
const TOLERANCE: f64 = 1e-17;

/// Most steps of a way; once round a torus takes some ten.
const MOST_STEPS: usize = 300;

/// `n`, `L` and a vector of the body.
pub(super) type Axes<S> = [Vector3<S>; 3];

/// `H = L.L / (2 I^xx) + C n.(s n)` and `K / (I^xx D)`, `D` the spread of the principal values, of which `K` takes the traceless part.
#[derive(Debug, Clone, Copy)]
pub(super) struct Integrals<S> {
    /// Slopes of both by `L`, over `L`, and by `n`, over `n`.
    by_momentum: [Vector3<S>; 2],
    by_axis: [Vector3<S>; 2],
}

impl<S: Real> Integrals<S> {
    /// For traceless principal values and their spread.
    pub(super) fn new(spheroid: &RigidSpheroid<S>, s: &Vector3<S>, spread: S) -> Self {
        let one = Vector3::from_element(S::one());
        let adjugate = Vector3::new(s.y * s.z, s.z * s.x, s.x * s.y);
        let (c, inertia) = (spheroid.constant_c, spheroid.inertia_xx);
        Self {
            by_momentum: [one / inertia, s * (S::from_f64(2.0) / (inertia * spread))],
            by_axis: [s * (c * 2.0), adjugate * (-(c * 4.0) / spread)],
        }
    }

    /// Coefficients of the flow of `t H + k K`.
    fn of(&self, [t, k]: [S; 2]) -> [Vector3<S>; 2] {
        [self.by_momentum, self.by_axis].map(|[of_h, of_k]| of_h * t + of_k * k)
    }

    /// Rates of `n` and `L` along the flow of `t H + k K`.
    pub(super) fn rates(&self, times: [S; 2], [n, momentum, _]: &Axes<S>) -> [Vector3<S>; 2] {
        let [a, b] = self.of(times);
        let turn = a.component_mul(momentum);
        [turn.cross(n), turn.cross(momentum) + b.component_mul(n).cross(n)]
    }

    /// The flow of `t H + k K` for the time one: `H` for the time `t` and `K` for `k`, in any order, since they commute. Not a number where that takes
    /// more than [`MOST_STEPS`].
    pub(super) fn moved(&self, times: [S; 2], start: &Axes<S>) -> Axes<S> {
        let [a, b] = self.of(times);
        let (mut axes, mut lost, mut left) = (*start, [Vector3::zeros(); 3], 1.0);
        let mut steps = 0;
        while left > 0.0 {
            steps += 1;
            if steps > MOST_STEPS {
                return [Vector3::repeat(S::from_f64(f64::NAN)); 3];
            }
            let series = expand(&a, &b, &axes);
            let step = step_size(&series).min(left);
            left -= step;
            for (i, axis) in axes.iter_mut().enumerate() {
                let mut sum = Vector3::zeros();
                for term in series.iter().skip(1).rev() {
                    sum = (sum + term[i]) * S::from_f64(step);
                }
                // What rounding takes from the sum goes into the next one.
                let change = sum + lost[i];
                let moved = *axis + change;
                lost[i] = change - (moved - *axis);
                *axis = moved;
            }
        }
        axes
    }
}

fn expand<S: Real>(a: &Vector3<S>, b: &Vector3<S>, axes: &Axes<S>) -> [Axes<S>; ORDER + 1] {
    let mut series = [[Vector3::zeros(); 3]; ORDER + 1];
    let mut turns = [[Vector3::zeros(); 2]; ORDER];
    series[0] = *axes;
    for order in 0..ORDER {
        let [n, momentum, _] = series[order];
        turns[order] = [a.component_mul(&momentum), b.component_mul(&n)];
        let mut next = [Vector3::zeros(); 3];
        for i in 0..=order {
            let [turn, pull] = turns[i];
            let [n, momentum, equatorial] = series[order - i];
            next[0] += turn.cross(&n);
            next[1] += turn.cross(&momentum) + pull.cross(&n);
            next[2] += turn.cross(&equatorial);
        }
        series[order + 1] = next.map(|v| v / S::from_f64((order + 1) as f64));
    }
    series
}

/// Step after which the last two terms are below the tolerance.
fn step_size<S: Real>(series: &[Axes<S>; ORDER + 1]) -> f64 {
    let size = |terms: &Axes<S>| {
        let [n, momentum, equatorial] = terms.map(|v| length_or_zero(&v));
        let whole = length_or_zero(&series[0][1]);
        n.max(equatorial).max(momentum / whole)
    };
    [ORDER - 1, ORDER]
        .map(|order| (TOLERANCE / size(&series[order]).max(f64::MIN_POSITIVE)).powf(1.0 / order as f64))
        .into_iter()
        .fold(f64::INFINITY, f64::min)
}

fn length_or_zero<S: Real>(v: &Vector3<S>) -> f64 {
    length(&v.map(S::re))
}
