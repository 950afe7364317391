//! Steps of a splitting scheme, without allocation.

use crate::propagation::splitting::flows::{Angles, Field, Kick, Pair, dot};
use crate::propagation::splitting::ring::Ring;
use crate::propagation::splitting::scheme::{Ends, Scheme};

/// Most rotations of a scheme, its ends taken together.
pub(super) const MOST_STAGES: usize = 17;

/// Whole steps after which the rounding of the Casimirs `n.n` and `L.n` is taken out.
pub(super) const STEPS_BETWEEN_PROJECTIONS: u64 = 64;

/// A scheme made ready for one body, one `s^IJ` and one step.
///
/// Steps are taken "open": the flow at the end of a step and the same flow at the beginning of the next are one, so that a
/// step is [`Scheme::stages`] pairs of rotation and kick. [`open`](Self::open) and [`close`](Self::close) shift by that flow.
#[derive(Debug, Clone, Copy)]
pub(super) struct Steps<S> {
    pairs: [(S, Kick<S>); MOST_STAGES],
    stages: usize,
    end: End<S>,
    tensor: [S; 3],
    angles: Angles,
}

#[derive(Debug, Clone, Copy)]
enum End<S> {
    Rotation { forth: S, back: S },
    Kick { forth: Kick<S>, back: Kick<S> },
}

/// The angles of the rotations of a scheme where a whole step turns by at most `turn`.
pub(super) fn angles(scheme: &Scheme, turn: f64) -> Angles {
    let at_ends = if scheme.ends == Ends::Rotations { 2.0 * scheme.rotations[0].abs() } else { 0.0 };
    let longest = scheme.rotations.iter().fold(at_ends, |most, rotation| most.max(rotation.abs()));
    Angles::up_to(longest * turn)
}

impl Steps<f64> {
    /// `largest_rate` bounds `|w|` along the motion.
    pub(super) fn new(scheme: &Scheme, field: &Field<f64>, step: f64, largest_rate: f64) -> Self {
        Self::turning(scheme, field, step, angles(scheme, step.abs() * largest_rate))
    }
}

impl<S: Ring> Steps<S> {
    /// With those [`angles`] of its rotations, or smaller ones.
    #[inline(always)]
    pub(super) fn turning(scheme: &Scheme, field: &Field<S>, step: S, angles: Angles) -> Self {
        let stages = scheme.stages();
        let still = field.kick(0.0, 0.0, step);
        let mut pairs = [(step, still); MOST_STAGES];
        // With kicks at the ends the first is half of the last.
        let offset = if scheme.ends == Ends::Kicks { 1 } else { 0 };
        for (index, pair) in pairs[..stages].iter_mut().enumerate() {
            let kick = field.kick(scheme.kicks[index + offset], scheme.gradient(index + offset), step);
            *pair = (step * step.like(scheme.rotations[index]), kick);
        }
        let end = match scheme.ends {
            Ends::Rotations => {
                let half = step * step.like(scheme.rotations[0]);
                pairs[0].0 = half * half.like(2.0);
                End::Rotation { forth: half * half.like(-1.0), back: half }
            }
            Ends::Kicks => {
                let kick = |times: f64| field.kick(times * scheme.kicks[0], times * scheme.gradient(0), step);
                pairs[stages - 1].1 = kick(2.0);
                End::Kick { forth: kick(1.0), back: kick(-1.0) }
            }
        };
        Self { pairs, stages, end, tensor: field.tensor, angles }
    }

    /// Shifts a state at a step into the middle of its first flow.
    #[inline(always)]
    pub(super) fn open(&self, state: &mut Pair<S>) {
        match &self.end {
            End::Rotation { forth, .. } => state.rotate(*forth, self.angles),
            End::Kick { forth, .. } => state.kick(forth, &self.tensor),
        }
    }

    /// The inverse of [`open`](Self::open).
    #[inline(always)]
    pub(super) fn close(&self, state: &mut Pair<S>) {
        match &self.end {
            End::Rotation { back, .. } => state.rotate(*back, self.angles),
            End::Kick { back, .. } => state.kick(back, &self.tensor),
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
            self.run(state, now);
            project(state, casimir);
            left -= now;
        }
    }

    /// Whole steps of an open state, without taking out rounding.
    #[inline(always)]
    pub(super) fn run(&self, state: &mut Pair<S>, steps: u64) {
        let mut moving = *state;
        for _ in 0..steps {
            for (tau, kick) in &self.pairs[..self.stages] {
                moving.rotate(*tau, self.angles);
                moving.kick(kick, &self.tensor);
            }
        }
        *state = moving;
    }
}

/// Weight of a change of `w` beside one of `n`, where the value of `w.n` is mended.
const SHARE_OF_RATE: f64 = 1e-4;

/// Takes out what rounding did to `n.n = 1` and `w.n = casimir`, both constant along every flow. First order is enough: the
/// defects are of the size of rounding.
///
/// The rotations round in the same sense step after step, to `n` across `w`. So `n` is mended, in the plane of both; a change of
/// `w` would feed the energy step by step. Where `n` is nearly along `w` that alone would enlarge the rounding, and `w` takes a share.
#[inline(always)]
pub(super) fn project<S: Ring>(state: &mut Pair<S>, casimir: S) {
    let (n, w) = (state.axis, state.rate);
    let (n_n, n_w, w_w) = (dot(&n, &n), dot(&n, &w), dot(&w, &w));
    let one = casimir.like(1.0);
    let grow = (one - n_n) * casimir.like(0.5);
    let missing = casimir - n_w * (one + grow);
    let mut across = w;
    for i in 0..3 {
        across[i] = w[i] - n[i] * n_w;
    }
    let share = w_w * casimir.like(SHARE_OF_RATE);
    // Nothing to mend where the body does not turn.
    let part = missing.over(dot(&across, &across) + share);
    for i in 0..3 {
        state.axis_low[i] = state.axis_low[i] + (n[i] * grow + across[i] * part);
        state.rate_low[i] = state.rate_low[i] + n[i] * (share * part);
    }
}
