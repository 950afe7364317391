//! Spans of more turns than can be followed one by one: plans that keep phases, and pulses near given epochs.

use super::Event;
use super::signal::turning_rate;
use crate::error::Error;
use crate::observables::pulsar::{ClockPulse, PulsarClock};
use crate::parameters::Parameters;
use crate::plan::{Method, Plan, Request};
use crate::propagation::PhasedMotion;
use crate::solutions::averaged::AveragingOrder;

/// Rotation (rad) up to which every turn is followed.
const LARGEST_FOLLOWED: f64 = 1e5;

/// Largest error of directions (rad): derivatives by the averaged motion are then right to about as much.
const LARGEST_ERROR: f64 = 1e-3;

/// Most corrections of the time at which a turn with a number is looked for.
const MOST_CORRECTIONS: usize = 8;

/// Whether a span from the start to `end` is too long to be followed turn by turn.
pub(super) fn is_long(parameters: &Parameters<f64>, end: f64) -> bool {
    end * turning_rate(parameters) > LARGEST_FOLLOWED
}

/// The plan for a request from the start on: over a span too long to be followed turn by turn by a method that keeps its phases, the averaged motion if no other one
/// meets the tolerance.
///
/// # Errors
/// As for [`Problem::plan`](crate::dynamics::Problem::plan), and [`Error::Domain`] for the error of the averaged motion.
pub(super) fn plan(parameters: &Parameters<f64>, request: Request) -> Result<Plan, Error> {
    let (problem, end) = (parameters.problem()?, request.span.1);
    let plan = problem.plan(&request);
    let meets = |plan: &Plan| plan.method.is_some_and(Method::keeps_phases);
    if !is_long(parameters, end) || plan.as_ref().is_ok_and(meets) {
        return plan;
    }
    ensure_exact(&PhasedMotion::averaged(&problem, AveragingOrder::Second)?, end)?;
    problem.plan(&Request { method: Some(Method::Averaged), ..request })
}

/// Refuses a span to `end` whose pulses can neither be followed turn by turn nor found by a motion by phases.
///
/// # Errors
/// [`Error::Domain`] as for [`PhasedMotion::new`], and for an error of directions above 1e-3 rad.
pub fn check_span(parameters: &Parameters<f64>, end: f64) -> Result<(), Error> {
    if is_long(parameters, end) { motion(parameters, end).map(|_| ()) } else { Ok(()) }
}

fn motion(parameters: &Parameters<f64>, end: f64) -> Result<PhasedMotion, Error> {
    let motion = PhasedMotion::new(&parameters.problem()?, end)?;
    ensure_exact(&motion, end)?;
    Ok(motion)
}

fn ensure_exact(motion: &PhasedMotion, end: f64) -> Result<(), Error> {
    let error = motion.error_estimate(end);
    Error::ensure(
        error <= LARGEST_ERROR,
        "estimated error of directions (rad) over a span of more than 1e5 rad of rotation",
        error,
        "at most 1e-3: a weaker violation or a shorter span",
    )
}

fn clock(parameters: &Parameters<f64>, end: f64) -> Result<PulsarClock, Error> {
    PulsarClock::on(motion(parameters, end)?, &parameters.beam(), &parameters.observer())
}

/// A pulse with its times counted from the double nearest to its midpoint. The closest approach is not looked for.
fn event(pulse: &ClockPulse) -> Event {
    let ([epoch, rest], half) = (pulse.midpoint, pulse.duration / 2.0);
    Event { turn: pulse.number, epoch, start: rest - half, end: rest + half, closest: f64::NAN }
}

/// The pulse of the turn nearest to each of some times up to `end`, in their order; turns without a pulse have none, a turn is taken once, and no pulse before
/// the start.
///
/// # Errors
/// As for [`check_span`] and [`PulsarClock`].
pub(super) fn pulses_near(parameters: &Parameters<f64>, end: f64, times: &[f64]) -> Result<Vec<Event>, Error> {
    let clock = clock(parameters, end)?;
    let mut found: Vec<Event> = Vec::with_capacity(times.len());
    for &time in times {
        if let Some(pulse) = clock.pulse_near([time, 0.0])?
            && found.last().is_none_or(|last| last.turn < pulse.number)
            && pulse.midpoint[0] - pulse.duration / 2.0 > 0.0
        {
            found.push(event(&pulse));
        }
    }
    Ok(found)
}

/// The pulses of turns with given numbers, each looked for from a time near it in some other model; turns without a pulse are left out.
///
/// # Errors
/// As for [`check_span`] and [`PulsarClock`].
pub(super) fn pulses_numbered(
    parameters: &Parameters<f64>,
    end: f64,
    turns: &[(i64, f64)],
) -> Result<Vec<Event>, Error> {
    if turns.is_empty() {
        return Ok(Vec::new());
    }
    let clock = clock(parameters, end)?;
    let period = clock.period();
    let mut found = Vec::with_capacity(turns.len());
    for &(number, near) in turns {
        let mut time = [near, 0.0];
        for _ in 0..MOST_CORRECTIONS {
            let Some(pulse) = clock.pulse_near(time)? else { break };
            if pulse.number == number {
                found.push(event(&pulse));
                break;
            }
            time = [pulse.midpoint[0] + (number - pulse.number) as f64 * period, 0.0];
        }
    }
    Ok(found)
}
