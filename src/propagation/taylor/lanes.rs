//! Many motions at once, one in each lane of the vector registers.

use nalgebra::Vector3;

use crate::dynamics::AxisState;
use crate::error::Error;
use crate::numerics::arithmetic::{Arithmetic, Componentwise};
use crate::numerics::compensated::CompensatedVectors;
use crate::numerics::registers::Register;
use crate::numerics::ring::Ring;
use crate::numerics::side_by_side::SideBySide;
use crate::propagation::SampledProblem;
use crate::propagation::taylor::clock::Clock;
use crate::propagation::taylor::samples::{LIMIT, Samples, span_of};
use crate::propagation::taylor::scaled_problem::ScaledProblem;
use crate::propagation::taylor::series::{AXIS, MOMENTUM, Recurrence, change};
use crate::propagation::taylor::step_size::{Work, step_size};

/// A number for each motion in the lanes of one register.
type Lanes<R> = SideBySide<R, 1>;

type Outcome = Result<Samples<AxisState<f64>>, Error>;

/// A motion prepared for a lane.
struct Ready<'t> {
    scene: usize,
    times: &'t [f64],
    setup: ScaledProblem<f64, 2>,
}

/// States of motions at their times, by Taylor series in the lanes of `register`.
pub(in crate::propagation) fn axis_states_in_lanes<R: Register>(
    register: R,
    scenes: &[SampledProblem<'_>],
) -> Vec<Outcome> {
    let mut outcomes = Vec::with_capacity(scenes.len());
    let mut ready = Vec::with_capacity(scenes.len());
    for (scene, SampledProblem { problem, start, times, tolerance }) in scenes.iter().enumerate() {
        let setup = span_of(*start, times)
            .and_then(|span| ScaledProblem::new((true, Work::Quadratic), problem, span, *tolerance));
        outcomes.push(setup.map(|setup| {
            let samples = Samples::with_room(times.len(), setup.order);
            ready.push(Ready { scene, times, setup });
            samples
        }));
    }
    // Motions side by side share one order.
    ready.sort_by_key(|ready| ready.setup.order);
    for alike in ready.chunk_by(|a, b| a.setup.order == b.setup.order) {
        register.run(
            #[inline(always)]
            || propagate_alike(Componentwise(Lanes::splat(register, 0.0)), alike, &mut outcomes),
        );
    }
    outcomes
}

/// The progress of a lane.
struct Lane<'r> {
    ready: &'r Ready<'r>,
    clock: Clock,
}

/// Carries motions of one order through the lanes; a lane whose motion has ended starts the next one.
#[inline(always)]
fn propagate_alike<R: Register>(a: Componentwise<Lanes<R>>, motions: &[Ready<'_>], outcomes: &mut [Outcome]) {
    let order = motions[0].setup.order;
    let zero = a.zero();
    let (mut axis_rate, mut momentum_rate) = (zero, zero);
    let mut state = CompensatedVectors::new(a, [zero; 2]);
    let mut series = vec![[zero; 2]; order + 1];
    let mut recurrence = Recurrence::<Componentwise<Lanes<R>>, 2>::new(a, order, zero, zero, [zero; 3]);
    let mut waiting = motions.iter();
    let mut lanes: Vec<Option<Lane>> = (0..R::COUNT).map(|_| None).collect();
    loop {
        let mut changed = false;
        for (place, lane) in lanes.iter_mut().enumerate().filter(|(_, lane)| lane.is_none()) {
            let Some(ready) = waiting.next() else { break };
            let drive = ready.setup.drive();
            let rates = drive.rates();
            Lanes::put(&mut axis_rate, place, [rates.axis; 3]);
            Lanes::put(&mut momentum_rate, place, rates.momentum_of_principal);
            for i in [AXIS, MOMENTUM] {
                Lanes::put(&mut state.high[i], place, drive.start[i].vector().into());
                Lanes::put(&mut state.low[i], place, [0.0; 3]);
            }
            *lane = Some(Lane { ready, clock: Clock::new() });
            changed = true;
        }
        if lanes.iter().all(Option::is_none) {
            return;
        }
        if changed {
            recurrence.set_rates(axis_rate, momentum_rate);
        }
        recurrence.expand(&state.high, &mut series);
        let largest = |k: usize| series[k].map(|[x, y, z]| x.larger(y).larger(z));
        let sizes = [largest(order), largest(order - 1)];
        let mut h = zero;
        for (place, lane) in lanes.iter_mut().enumerate() {
            let Some(Lane { ready, clock }) = lane else { continue };
            let (setup, drive) = (&ready.setup, ready.setup.drive());
            let sizes = sizes.map(|[axis, momentum]| setup.scale.size_of_both(axis.get(place), momentum.get(place)));
            let wanted = step_size(sizes, order, &setup.scale, drive.budget).min(drive.longest_step);
            let step = match clock.advance(wanted, drive.duration, LIMIT) {
                Ok(step) => step,
                Err(error) => {
                    outcomes[ready.scene] = Err(error);
                    *lane = None;
                    continue;
                }
            };
            if let Ok(samples) = &mut outcomes[ready.scene] {
                samples.step_count = clock.steps;
                samples.take(setup, ready.times, &step, |t| {
                    let h = setup.series_time(&step.start, t);
                    let change = change(a, order, |k| series[k], [a.0.like(h); 3]);
                    let [axis, momentum] = [AXIS, MOMENTUM].map(|i| {
                        setup.frame.turned_back(&Vector3::from(Lanes::take(&a.add(series[0][i], change[i]), place)))
                    });
                    AxisState { axis, momentum }
                });
            }
            if step.is_last() {
                *lane = None;
            } else {
                Lanes::put(&mut h, place, [step.length * drive.direction / setup.scale.time; 3]);
            }
        }
        state.add(a, &change(a, order, |k| series[k], h));
    }
}

#[cfg(all(test, target_arch = "x86_64"))]
mod tests {
    use super::*;
    use crate::dynamics::fixture::axis_problem;
    use crate::numerics::arithmetic::plain;
    use crate::propagation::taylor::samples::visited;

    /// More motions than lanes, forwards and backwards in time, of several orders.
    #[test]
    fn a_motion_in_a_lane_is_the_motion_alone() {
        let Some(register) = pulp::x86::V3::try_new() else { return };
        let (onwards, back) = ([3.0, 3.0, 40.0, 47.5], [-0.1, -2.0, -33.0]);
        let motion = |i: usize| SampledProblem {
            problem: axis_problem([0.02, 0.01, -0.03].map(|value| value * (1.0 + 0.1 * i as f64))),
            start: 0.0,
            times: if i.is_multiple_of(3) { &back[..] } else { &onwards },
            tolerance: 10_f64.powi(-5 - 4 * (i % 3) as i32),
        };
        let motions: Vec<_> = (0..31).map(motion).collect();
        for (motion, found) in motions.iter().zip(axis_states_in_lanes(register, &motions)) {
            let SampledProblem { problem, start, times, tolerance } = motion;
            let span = (*start, times[times.len() - 1]);
            let setup = ScaledProblem::new((true, Work::Quadratic), problem, span, *tolerance).unwrap();
            let alone = visited(&setup, plain(), times, |vectors: [Vector3<f64>; 2], _| vectors);
            let (found, alone) = (found.unwrap(), alone.unwrap());
            assert_eq!((found.step_count, found.order), (alone.step_count, alone.order));
            assert!(found.step_count > 3 && found.states.len() == times.len());
            for (state, [axis, momentum]) in found.states.iter().zip(alone.states) {
                // Vectors of length one and of about that length, after some ten steps of rounding.
                assert!((state.axis - axis).amax() < 1e-14 && (state.momentum - momentum).amax() < 1e-14);
            }
            // The same bits, whatever was in its lane before.
            assert_eq!(axis_states_in_lanes(register, &[*motion]), [Ok(found)]);
        }
    }
}
