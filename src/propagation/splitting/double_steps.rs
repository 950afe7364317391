//! Steps of one motion, with fused multiply-add if the processor has it.

use crate::numerics::fused::{Fused, detect_fused, run_fused};
use crate::numerics::ring::{Double, FusedDouble};
use crate::propagation::splitting::flows::{Field, Moving};
use crate::propagation::splitting::scheme::Scheme;
use crate::propagation::splitting::stepper::{Steps, angles};

/// Steps of one scheme and one length, with the available instructions. States are opened, advanced and closed as by
/// [`Steps`].
#[derive(Debug, Clone)]
#[allow(clippy::large_enum_variant, reason = "both are of one size but for the proof of the instructions")]
pub(super) enum DoubleSteps {
    Plain(Steps<f64>),
    Fused(Fused, Steps<FusedDouble>),
}

/// Applies an expression to either kind of steps, compiled for their instructions.
macro_rules! by {
    ($one:expr, $steps:ident => $work:expr) => {
        match $one {
            DoubleSteps::Plain($steps) => $work,
            DoubleSteps::Fused(fused, $steps) => run_fused(
                *fused,
                #[inline(always)]
                || $work,
            ),
        }
    };
}

impl DoubleSteps {
    /// `largest_rate` bounds `|w|` along the motion.
    pub(super) fn new(scheme: &Scheme, field: &Field<f64>, step: f64, largest_rate: f64) -> Self {
        let angles = angles(scheme, step.abs() * largest_rate);
        match detect_fused() {
            None => Self::Plain(Steps::turning(scheme, field, step, angles)),
            Some(fused) => {
                let steps = run_fused(
                    fused,
                    #[inline(always)]
                    || Steps::turning(scheme, &field.convert(), FusedDouble(step), angles),
                );
                Self::Fused(fused, steps)
            }
        }
    }

    pub(super) fn open<const V: usize>(&self, state: &mut Moving<f64, V>) {
        by!(self, steps => on(state, #[inline(always)] |state| steps.open(state)));
    }

    pub(super) fn close<const V: usize>(&self, state: &mut Moving<f64, V>) {
        by!(self, steps => on(state, #[inline(always)] |state| steps.close(state)));
    }

    /// One step of a closed state.
    pub(super) fn single<const V: usize>(&self, state: &mut Moving<f64, V>, casimir: f64) {
        by!(self, steps => on(state, #[inline(always)] |state| steps.single(state, Double::of(casimir))));
    }

    /// Whole steps of an open state.
    pub(super) fn advance<const V: usize>(&self, state: &mut Moving<f64, V>, casimir: f64, count: u64) {
        by!(self, steps => on(state, #[inline(always)] |state| steps.advance(state, Double::of(casimir), count)));
    }

    /// Whole steps of an open state, which is recorded after every `stride` of them, `count` times.
    pub(super) fn keep<const V: usize>(
        &self,
        state: &mut Moving<f64, V>,
        casimir: f64,
        (stride, count): (u64, u64),
        states: &mut Vec<Moving<f64, V>>,
    ) {
        by!(self, steps => on(
            state,
            #[inline(always)]
            |state| {
                for _ in 0..count {
                    steps.advance(state, Double::of(casimir), stride);
                    states.push(state.convert());
                }
            }
        ));
    }
}

/// Does `work` on a state in another type of doubles.
#[inline(always)]
fn on<S: Double, const V: usize>(state: &mut Moving<f64, V>, work: impl FnOnce(&mut Moving<S, V>)) {
    let mut moving = state.convert();
    work(&mut moving);
    *state = moving.convert();
}
