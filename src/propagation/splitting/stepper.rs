//! Steps of a splitting scheme, without allocation.

use crate::numerics::ring::Ring;
use crate::propagation::splitting::flows::{Angles, Field, Kick, Moved};
use crate::propagation::splitting::scheme::{Ends, Scheme};

/// Largest number of rotations of a scheme, with its ends merged.
pub(super) const MOST_STAGES: usize = 17;

/// Number of whole steps after which the rounding of the Casimirs `n.n` and `L.n` is removed.
pub(super) const STEPS_BETWEEN_PROJECTIONS: u64 = 64;

/// A scheme prepared for one body, one `s^IJ` and one step.
///
/// Steps are taken "open": the flow at the end of a step is merged with the same flow at the beginning of the next, so that a
/// step is [`Scheme::stages`] pairs of rotation and kick. [`open`](Self::open) and [`close`](Self::close) shift by that flow.
#[derive(Debug, Clone, Copy)]
pub(super) struct Steps<S> {
    pairs: [(S, Kick<S>); MOST_STAGES],
    stages: usize,
    end: End<S>,
    angles: Angles,
}

#[derive(Debug, Clone, Copy)]
enum End<S> {
    Rotation { forth: S, back: S },
    Kick { forth: Kick<S>, back: Kick<S> },
}

/// The angles of the rotations of a scheme in which a whole step rotates by at most `turn`.
pub(super) fn angles(scheme: &Scheme, turn: f64) -> Angles {
    let at_ends = if scheme.ends == Ends::Rotations { 2.0 * scheme.rotations[0].abs() } else { 0.0 };
    let longest = scheme.rotations.iter().fold(at_ends, |most, rotation| most.max(rotation.abs()));
    Angles::up_to(longest * turn)
}

impl<S: Ring> Steps<S> {
    /// The steps of a scheme. `angles` must cover its rotations: see [`angles`].
    #[inline(always)]
    pub(super) fn turning(scheme: &Scheme, field: &Field<S>, step: S, angles: Angles) -> Self {
        let stages = scheme.stages();
        let still = field.kick(0.0, 0.0, step);
        let mut pairs = [(step, still); MOST_STAGES];
        // With kicks at the ends the first kick is half of the last.
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
        Self { pairs, stages, end, angles }
    }

    /// Shifts a state at a step into the middle of its first flow.
    #[inline(always)]
    pub(super) fn open<M: Moved<S>>(&self, state: &mut M) {
        match &self.end {
            End::Rotation { forth, .. } => state.rotate(*forth, self.angles),
            End::Kick { forth, .. } => state.kick(forth),
        }
    }

    /// The inverse of [`open`](Self::open).
    #[inline(always)]
    pub(super) fn close<M: Moved<S>>(&self, state: &mut M) {
        match &self.end {
            End::Rotation { back, .. } => state.rotate(*back, self.angles),
            End::Kick { back, .. } => state.kick(back),
        }
    }

    /// One step of a closed state.
    #[inline(always)]
    pub(super) fn single<M: Moved<S>>(&self, state: &mut M, casimir: S) {
        self.open(state);
        self.advance(state, casimir, 1);
        self.close(state);
    }

    /// Whole steps of an open state.
    #[inline(always)]
    pub(super) fn advance<M: Moved<S>>(&self, state: &mut M, casimir: S, steps: u64) {
        let mut left = steps;
        while left > 0 {
            let now = left.min(STEPS_BETWEEN_PROJECTIONS);
            self.run(state, now);
            state.project(casimir);
            left -= now;
        }
    }

    /// Whole steps of an open state, without removing rounding.
    #[inline(always)]
    pub(super) fn run<M: Moved<S>>(&self, state: &mut M, steps: u64) {
        let mut moving = *state;
        for _ in 0..steps {
            for (tau, kick) in &self.pairs[..self.stages] {
                moving.rotate(*tau, self.angles);
                moving.kick(kick);
            }
        }
        *state = moving;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::propagation::splitting::flows::Moving;
    use crate::propagation::splitting::{NEAR_INTEGRABLE_6_2, STRANG};

    #[test]
    fn the_longest_rotation_is_that_of_two_ends_together() {
        let Scheme { name, orders, kicks, gradients, source, .. } = STRANG;
        let scheme = |ends| Scheme { ends, rotations: &[-0.45, 0.1, -0.45], name, orders, kicks, gradients, source };
        // The series have five terms up to 0.09 rad, six up to 0.19 and eight beyond.
        let terms = |ends, turn| angles(&scheme(ends), turn).terms;
        assert_eq!((terms(Ends::Rotations, 0.19), terms(Ends::Kicks, 0.19)), (6, 5));
        assert_eq!((terms(Ends::Rotations, 0.22), terms(Ends::Kicks, 0.22)), (8, 6));
    }

    #[test]
    fn rounding_is_taken_out_after_every_64_steps_and_at_the_end() {
        let field = Field::new(1.7, [0.3, -0.2, 0.5]);
        let steps = Steps::turning(&NEAR_INTEGRABLE_6_2, &field, 0.3, angles(&NEAR_INTEGRABLE_6_2, 0.6));
        let start = Moving::new([[0.48, 0.6, 0.64], [0.3, -0.7, 1.1]]);
        let casimir = 0.48 * 0.3 - 0.6 * 0.7 + 0.64 * 1.1;
        let (mut found, mut expected) = (start, start);
        steps.advance(&mut found, casimir, 137);
        for count in [64, 64, 9] {
            steps.run(&mut expected, count);
            expected.project(casimir);
        }
        assert_eq!(found, expected);
    }
}
