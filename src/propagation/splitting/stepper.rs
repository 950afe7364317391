//! Steps of a splitting scheme, without allocation.

use crate::propagation::splitting::flows::{Field, Kick, LARGEST_ANGLE, Pair, dot};
use crate::propagation::splitting::scheme::{Ends, Scheme};
use crate::scalar::{Real, Scalar};

/// Most rotations of a scheme, its ends taken together.
pub(super) const MOST_STAGES: usize = 17;

/// Whole steps after which the rounding of the Casimirs `n.n` and `L.n` is taken out.
const STEPS_BETWEEN_PROJECTIONS: u64 = 64;

/// A scheme made ready for one body, one `s^IJ` and one step.
///
/// Steps are taken "open": the flow at the end of a step and the same flow at the beginning of the next are one, so that a
/// step is [`Scheme::stages`] pairs of rotation and kick. [`open`](Self::open) and [`close`](Self::close) shift by that flow.
#[derive(Debug, Clone, Copy)]
pub(super) struct Steps<S> {
    pairs: [(S, Kick<S>); MOST_STAGES],
    stages: usize,
    end: End<S>,
    halvings: u32,
}

#[derive(Debug, Clone, Copy)]
enum End<S> {
    Rotation(S),
    Kick { forth: Kick<S>, back: Kick<S> },
}

impl<S: Real> Steps<S> {
    /// `largest_rate` bounds `|w|` along the motion.
    pub(super) fn new(scheme: &Scheme, field: &Field<S>, step: S, largest_rate: f64) -> Self {
        let kick =
            |index: usize, times: f64| field.kick(times * scheme.kicks[index], times * scheme.gradient(index), step);
        let stages = scheme.stages();
        let still = kick(0, 0.0);
        let mut pairs = [(S::zero(), still); MOST_STAGES];
        let end = match scheme.ends {
            Ends::Rotations => {
                for (index, pair) in pairs[..stages].iter_mut().enumerate() {
                    *pair = (step * scheme.rotations[index], kick(index, 1.0));
                }
                pairs[0].0 = pairs[0].0 * 2.0;
                End::Rotation(step * scheme.rotations[0])
            }
            Ends::Kicks => {
                for (index, pair) in pairs[..stages].iter_mut().enumerate() {
                    *pair = (step * scheme.rotations[index], kick(index + 1, 1.0));
                }
                pairs[stages - 1].1 = kick(0, 2.0);
                End::Kick { forth: kick(0, 1.0), back: kick(0, -1.0) }
            }
        };
        let longest = pairs.iter().fold(0.0_f64, |most, (tau, _)| most.max(tau.re().abs()));
        let halvings = (longest * largest_rate / LARGEST_ANGLE).log2().ceil().max(0.0) as u32;
        Self { pairs, stages, end, halvings }
    }

    /// Shifts a state at a step into the middle of its first flow.
    #[inline]
    pub(super) fn open(&self, state: &mut Pair<S>) {
        match &self.end {
            End::Rotation(tau) => state.rotate(-*tau, self.halvings),
            End::Kick { forth, .. } => state.kick(forth),
        }
    }

    /// The inverse of [`open`](Self::open).
    #[inline]
    pub(super) fn close(&self, state: &mut Pair<S>) {
        match &self.end {
            End::Rotation(tau) => state.rotate(*tau, self.halvings),
            End::Kick { back, .. } => state.kick(back),
        }
    }

    /// One step of a closed state.
    pub(super) fn single(&self, state: &mut Pair<S>, casimir: S) {
        self.open(state);
        self.advance(state, casimir, 1);
        self.close(state);
    }

    /// Whole steps of an open state.
    pub(super) fn advance(&self, state: &mut Pair<S>, casimir: S, steps: u64) {
        let mut left = steps;
        while left > 0 {
            let now = left.min(STEPS_BETWEEN_PROJECTIONS);
            for _ in 0..now {
                for (tau, kick) in &self.pairs[..self.stages] {
                    state.rotate(*tau, self.halvings);
                    state.kick(kick);
                }
            }
            project(state, casimir);
            left -= now;
        }
    }
}

/// Weight of a change of `w` beside one of `n`, where the value of `w.n` is mended.
const SHARE_OF_RATE: f64 = 1e-4;

/// Takes out what rounding did to `n.n = 1` and `w.n = casimir`, both constant along every flow. First order is enough: the
/// defects are of the size of rounding.
///
/// The rotations round in the same sense step after step, to `n` across `w`. So `n` is mended, in the plane of both; a change of
/// `w` would feed the energy step by step. Where `n` is nearly along `w` that alone would enlarge the rounding, and `w` takes a share.
fn project<S: Scalar>(state: &mut Pair<S>, casimir: S) {
    let (n, w) = (state.axis, state.rate);
    let (n_n, n_w, w_w) = (dot(&n, &n), dot(&n, &w), dot(&w, &w));
    let grow = (S::one() - n_n) * 0.5;
    let missing = casimir - n_w * (S::one() + grow);
    let across = [0, 1, 2].map(|i| w[i] - n[i] * n_w);
    let share = w_w * SHARE_OF_RATE;
    let weight = dot(&across, &across) + share;
    if weight.is_zero() {
        return;
    }
    let part = missing / weight;
    for i in 0..3 {
        state.axis_low[i] += n[i] * grow + across[i] * part;
        state.rate_low[i] += n[i] * (share * part);
    }
}
