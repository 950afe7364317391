//! The Jacobian of data with respect to unknowns, from exact derivatives.
//!
//! The states and their derivatives come from a single motion ([`plan::gradient`](crate::plan::gradient)). The column of an unknown is a sum of
//! columns of the numbers of [`Parameters`] that it changes.

use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::f64::consts::SQRT_2;

use nalgebra::{DMatrix, DVector, Vector3};
use num_dual::Dual64;

use super::signal::{TOLERANCE, strain, turning_rate};
use super::{Datum, Event, InferenceError, Observable, Place, long_span};
use crate::dynamics::BodyState;
use crate::error::Error;
use crate::lorentz_violation::traceless;
use crate::observables::pulsar::event_time::event_time;
use crate::parameters::{Parameter, Parameters};
use crate::plan::{Gradient, Method, Output, Request, gradient_in_parts};

/// Derivatives of data with respect to unknowns.
#[derive(Debug, Clone, PartialEq)]
pub struct Jacobian {
    /// A row for each datum, a column for each unknown.
    pub matrix: DMatrix<f64>,
    /// For each entry of the matrix, which is a sum, the sum of the magnitudes of its terms; rounding is relative to these.
    pub magnitudes: DMatrix<f64>,
    /// Relative error of the terms.
    pub relative_error: f64,
    /// How much each datum changes if the directions of the star are off by [`relative_error`](Self::relative_error). If an unknown changes a datum
    /// by less than this over its whole range, the change is rounding.
    pub rounding: DVector<f64>,
}

/// Largest ratio between the error of derivatives and their tolerance: `gradient-both-ways` finds 8 in 3,000 motions.
const SAFETY: f64 = 20.0;

/// The Jacobian of `data` with respect to `unknowns`, at the pulses `events` of a star with these parameters.
///
/// # Errors
/// [`InferenceError::NoPulse`] for a datum of a turn without a pulse in `events`; [`InferenceError::Model`] for a motion that
/// cannot be computed, and for a pulse where the line of sight only touches the edge of the beam.
pub fn jacobian(
    parameters: &Parameters<f64>,
    events: &[Event],
    data: &[Datum],
    unknowns: &[Parameter],
) -> Result<Jacobian, InferenceError> {
    let by_turn: BTreeMap<i64, &Event> = events.iter().map(|event| (event.turn, event)).collect();
    let terms = data.iter().map(|datum| Term::of(datum, &by_turn)).collect::<Result<Vec<_>, _>>()?;
    let (numbers, weights) = weights(parameters, unknowns);
    let base = parameters.holding_gamma_rate();
    let states = States::new(&base, &terms, &numbers)?;
    let mut by_numbers = DMatrix::zeros(data.len(), numbers.len());
    for (column, number) in numbers.iter().enumerate() {
        let seeded = base.seeded(*number);
        for (row, (datum, term)) in data.iter().zip(&terms).enumerate() {
            by_numbers[(row, column)] = term.value(&seeded, datum.observable, &|t| states.at(t, column))?.eps;
        }
    }
    let rotation = if states.phases_are_kept { 0.0 } else { last(&states.times) * turning_rate(parameters) };
    let relative_error = SAFETY * (TOLERANCE + f64::EPSILON * rotation);
    // Only the values are used.
    let star = base.seeded(Parameter::Rho);
    let per_radian = |(datum, term): (&Datum, &Term)| term.per_radian(&star, datum.observable, &|t| states.at(t, 0));
    let found = Jacobian {
        matrix: &by_numbers * &weights,
        magnitudes: by_numbers.abs() * weights.abs(),
        relative_error,
        rounding: DVector::from_iterator(data.len(), data.iter().zip(&terms).map(per_radian)) * relative_error,
    };
    match found.matrix.iter().find(|value| !value.is_finite()) {
        Some(&value) => {
            let (quantity, allowed) = (
                "derivative of a datum",
                "finite; it is infinite where the line of sight only touches the edge of the beam",
            );
            Err(Error::Domain { quantity, value, allowed }.into())
        }
        None => Ok(found),
    }
}

/// The numbers that the unknowns change, those of the motion first, and how much each of them (row) changes with each unknown (column).
fn weights(parameters: &Parameters<f64>, unknowns: &[Parameter]) -> (Vec<Parameter>, DMatrix<f64>) {
    let numbers: Vec<Parameter> = Parameter::OF_MOTION.into_iter().chain(Parameter::OF_SIGHT).collect();
    let seeded: Vec<_> = unknowns.iter().map(|unknown| parameters.seeded(*unknown)).collect();
    let all = DMatrix::from_fn(numbers.len(), unknowns.len(), |row, column| numbers[row].value(&seeded[column]).eps);
    let used: Vec<usize> = (0..numbers.len()).filter(|row| all.row(*row).amax() > 0.0).collect();
    (used.iter().map(|row| numbers[*row]).collect(), all.select_rows(&used))
}

/// Order of two times, each in two parts.
fn order(a: &[f64; 2], b: &[f64; 2]) -> Ordering {
    a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1]))
}

/// States with derivatives at the times of the data.
struct States {
    times: Vec<[f64; 2]>,
    found: Gradient,
    phases_are_kept: bool,
}

impl States {
    fn new(parameters: &Parameters<f64>, terms: &[Term], numbers: &[Parameter]) -> Result<Self, Error> {
        let mut times: Vec<[f64; 2]> = terms.iter().flat_map(Term::times).collect();
        times.sort_by(order);
        times.dedup();
        let needs_beam = terms.iter().any(|term| !matches!(term, Term::Sample(_)));
        let output = if needs_beam { Output::PulseProfile } else { Output::GravitationalWave };
        let of_motion = numbers.iter().copied().filter(|number| Parameter::OF_MOTION.contains(number));
        let request = Request {
            derivatives: of_motion.collect(),
            ..Request::new(&[output], (0.0, last(&times)), times.len(), TOLERANCE)
        };
        let plan = long_span::plan(parameters, request)?;
        let found = gradient_in_parts(&plan, parameters, &times)?;
        Ok(Self { times, found, phases_are_kept: plan.method.is_some_and(Method::keeps_phases) })
    }

    /// The state at a time with its derivative with respect to the number of a column; the derivative is zero for a number
    /// that the motion does not depend on.
    fn at(&self, t: [f64; 2], column: usize) -> BodyState<Dual64> {
        let row = self.times.partition_point(|time| order(time, &t).is_lt());
        let (values, jacobian) = (&self.found.values, &self.found.jacobians[row]);
        let derivative = |place: usize| jacobian.get((place, column)).copied().unwrap_or(0.0);
        let vector =
            |first: usize| Vector3::from_fn(|i, _| Dual64::new(values[(row, first + i)], derivative(first + i)));
        BodyState { axis: vector(0), momentum: vector(3), equatorial_axis: vector(6) }
    }
}

/// The last of some times.
fn last(times: &[[f64; 2]]) -> f64 {
    times.iter().fold(0.0, |last, [epoch, t]| last.max(epoch + t))
}

/// The part of the signal that a datum depends on.
enum Term {
    /// One pulse.
    Pulse(Event),
    /// Two pulses of consecutive turns.
    Pulses(Event, Event),
    /// The state at a time.
    Sample(f64),
}

impl Term {
    fn of(datum: &Datum, events: &BTreeMap<i64, &Event>) -> Result<Self, InferenceError> {
        let (number, near) = match datum.place {
            Place::Time(t) => return Ok(Self::Sample(t)),
            Place::Turn { number, near } => (number, near),
        };
        let event =
            |turn: i64| events.get(&turn).map(|event| **event).ok_or(InferenceError::NoPulse { turn: number, near });
        Ok(match datum.observable {
            Observable::Periods => Self::Pulses(event(number - 1)?, event(number)?),
            _ => Self::Pulse(event(number)?),
        })
    }

    fn times(&self) -> Vec<[f64; 2]> {
        let of = |event: &Event, times: &[f64]| -> Vec<[f64; 2]> {
            times.iter().filter(|t| t.is_finite()).map(|t| [event.epoch, *t]).collect()
        };
        match self {
            Self::Pulse(event) => of(event, &[event.start, event.end, event.closest]),
            Self::Pulses(before, event) => {
                [of(before, &[before.start, before.end]), of(event, &[event.start, event.end])].concat()
            }
            Self::Sample(t) => vec![[*t, 0.0]],
        }
    }

    /// Largest change of the datum per radian by which `n` and `L` are turned together. For the time of an edge of a pulse it is the sine of the
    /// semi-open angle of the beam over the rate at which `m.n` crosses the edge. For a strain it is at most
    /// `8 |Delta| (L.L / I^xx + Gamma)` in its unit, with the largest torque `Gamma = 2^(1/2) |C| |s|` for `s` without its trace: a radian changes
    /// the torque, and the polarization tensors as seen from the star, by at most twice their size. The free wave of a symmetry axis normal to `L`, seen
    /// along `L`, `4 Delta L.L / I^xx cos 2 alpha`, reaches it.
    fn per_radian(
        &self,
        parameters: &Parameters<Dual64>,
        observable: Observable,
        state: &impl Fn([f64; 2]) -> BodyState<Dual64>,
    ) -> f64 {
        let (beam, n) = (parameters.beam(), parameters.observer().direction);
        let Parameters { spheroid, coefficients: s, bulge, .. } = parameters;
        let margin = |event: &Event, t: f64| {
            beam.margin_rates(spheroid, s, *bulge, &state([event.epoch, t]), &n).map(|rate| rate.re.abs())
        };
        // At an edge `m.n` changes by at most the sine of the angle between them.
        let sine = parameters.rho.re.sin();
        let edges = |event: &Event| sine / margin(event, event.start)[1] + sine / margin(event, event.end)[1];
        match (self, observable) {
            (Self::Pulse(event), Observable::ClosestApproaches) => {
                let [_, _, second, _] = margin(event, event.closest);
                let momentum = state([event.epoch, event.closest]).momentum.map(|x| x.re);
                momentum.norm() / (spheroid.inertia_xx.re * second)
            }
            (Self::Pulse(event), _) => edges(event),
            (Self::Pulses(before, event), _) => edges(before) + edges(event),
            (Self::Sample(t), _) => {
                let momentum = state([*t, 0.0]).momentum.map(|x| x.re);
                let torque = SQRT_2 * spheroid.constant_c.re.abs() * traceless(&s.map(|x| x.re)).norm();
                let rotation = momentum.norm_squared() / spheroid.inertia_xx.re;
                let unit = parameters.strain_scale * parameters.strain_unit * spheroid.oblateness();
                8.0 * unit.re.abs() * (rotation + torque)
            }
        }
    }

    /// The datum as a function of one number.
    fn value(
        &self,
        parameters: &Parameters<Dual64>,
        observable: Observable,
        state: &impl Fn([f64; 2]) -> BodyState<Dual64>,
    ) -> Result<Dual64, Error> {
        let (beam, n) = (parameters.beam(), parameters.observer().direction);
        let Parameters { spheroid, coefficients: s, bulge, .. } = parameters;
        let margin = |event: &Event, t: f64| beam.margin_rates(spheroid, s, *bulge, &state([event.epoch, t]), &n);
        let edge = |event: &Event, t: f64| {
            let [value, rate, ..] = margin(event, t);
            event_time(t, value, rate.re)
        };
        let midpoint = |event: &Event| Ok((edge(event, event.start)? + edge(event, event.end)?) / 2.0);
        match (self, observable) {
            (Self::Pulse(event), Observable::Widths) => Ok(edge(event, event.end)? - edge(event, event.start)?),
            (Self::Pulse(event), Observable::ClosestApproaches) => {
                let [_, rate, second, _] = margin(event, event.closest);
                event_time(event.closest, rate, second.re)
            }
            (Self::Pulse(event), _) => midpoint(event),
            (Self::Pulses(before, event), _) => Ok(midpoint(event)? - midpoint(before)?),
            (Self::Sample(t), _) => {
                let BodyState { axis, momentum, .. } = state([*t, 0.0]);
                Ok(strain(parameters, [&axis, &momentum], observable))
            }
        }
    }
}

impl Jacobian {
    /// The Jacobian with each row divided by the standard deviation of its datum.
    pub(crate) fn weighted(mut self, data: &[Datum]) -> Self {
        let weights = DVector::from_iterator(data.len(), data.iter().map(|datum| 1.0 / datum.sigma));
        for matrix in [&mut self.matrix, &mut self.magnitudes] {
            matrix.row_iter_mut().zip(&weights).for_each(|(mut row, weight)| row *= *weight);
        }
        self.rounding.component_mul_assign(&weights);
        self
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Matrix3;
    use rand::rngs::ChaCha8Rng;
    use rand::{RngExt, SeedableRng};

    use super::*;
    use crate::dynamics::RigidSpheroid;
    use crate::inference::{Signal, data_of, stars};
    use crate::propagation::Motion;

    fn strain_at(star: &Parameters<f64>, times: &[f64]) -> Vec<Datum> {
        let signal = Signal::new(star, *times.last().expect("a time")).expect("a motion");
        data_of(&signal, &[], times, &[(Observable::StrainPlus, 0.5), (Observable::StrainCross, 0.25)]).expect("data")
    }

    /// The terms of a sum have magnitudes no smaller than the sum: for `s_axial` two of three weights are negative.
    #[test]
    fn magnitudes_are_those_of_the_terms() {
        let star = stars::precessing();
        let data = strain_at(&star, &[1.0, 5.0, 12.0]);
        let unknowns = [Parameter::SAxial, Parameter::Spin, Parameter::STrace];
        let found = jacobian(&star, &[], &data, &unknowns).expect("derivatives");
        let sums = found.matrix.iter().zip(&found.magnitudes);
        assert!(sums.clone().all(|(sum, magnitude)| sum.abs() <= magnitude * (1.0 + 1e-12)), "{found:?}");
        // The trace does not affect the motion: its terms cancel.
        assert!(found.matrix.column(2).amax() < 1e-12 * found.magnitudes.column(2).amax());
        let weighted = found.clone().weighted(&data);
        for (row, datum) in data.iter().enumerate() {
            for column in 0..unknowns.len() {
                assert_eq!(weighted.matrix[(row, column)] * datum.sigma, found.matrix[(row, column)]);
                assert_eq!(weighted.magnitudes[(row, column)] * datum.sigma, found.magnitudes[(row, column)]);
            }
            assert_eq!(weighted.rounding[row] * datum.sigma, found.rounding[row]);
        }
    }

    /// A motion is computed for no longer than its data need.
    #[test]
    fn the_last_time_is_that_of_the_data() {
        assert_eq!(last(&[[0.0, 0.25], [0.5, 0.125], [0.25, 0.0]]), 0.625);
    }

    /// By differences of `m.n`: an edge moves by `sin(rho) / |d(m.n)/dt|` per radian, the closest approach by the rotation rate over `|d2(m.n)/dt2|`, and
    /// a period as both of its pulses.
    #[test]
    fn rounding_of_pulses_is_that_of_the_directions() {
        let mut star = stars::precessing();
        star.spheroid.inertia_xx = 2.0;
        star.spheroid.inertia_zz *= 2.0;
        let signal = Signal::new(&star, 20.0).expect("a motion");
        let events = signal.events().expect("pulses");
        let kinds = [Observable::Arrivals, Observable::ClosestApproaches, Observable::Periods].map(|kind| (kind, 1.0));
        let data = data_of(&signal, &events, &[], &kinds).expect("data");
        let found = jacobian(&star, &events, &data, &[Parameter::Spin]).expect("derivatives");
        let motion = star.problem().and_then(|problem| problem.taylor((0.0, 20.0), 1e-14)).expect("a motion");
        let margin = |t: f64| star.beam().margin(&motion.state(t).expect("a state"), &star.observer().direction);
        let h = 1e-4;
        let edge = |t: f64| star.rho.sin() * 2.0 * h / (margin(t + h) - margin(t - h)).abs();
        let edges = |event: &Event| edge(event.start) + edge(event.end);
        let closest = |event: &Event| {
            let t = event.closest;
            turning_rate(&star) * h * h / (margin(t + h) - 2.0 * margin(t) + margin(t - h)).abs()
        };
        let expected = events.iter().map(edges).chain(events.iter().map(closest));
        let expected = expected.chain(events.windows(2).map(|pair| edges(&pair[0]) + edges(&pair[1])));
        let expected: Vec<f64> = expected.collect();
        assert!(events.len() > 2 && expected.len() == data.len(), "{events:?}");
        for (found, expected) in found.rounding.iter().zip(expected) {
            assert!((found / (expected * 2e-12) - 1.0).abs() < 0.1, "{found:e} {expected:e}");
        }
    }

    /// By turning stars about random axes: a strain changes by at most so much per radian, for some fast stars by nearly all of it, and for slow ones,
    /// where the terms of the torque are the larger ones, by nearly half.
    #[test]
    fn rounding_of_strains_is_at_most_that_of_the_directions() {
        let mut random = ChaCha8Rng::seed_from_u64(1);
        let mut number = move || random.random_range(-1.0..1.0_f64);
        let unit = |star: &mut Parameters<f64>, inertia_xx: f64, constant_c, oblateness: f64| {
            star.spheroid = RigidSpheroid { inertia_xx, inertia_zz: inertia_xx * (1.0 + oblateness), constant_c };
            // The trace exerts no torque.
            star.coefficients += Matrix3::identity() * 0.4;
            (star.strain_scale, star.strain_unit) = (-3.0, 0.125);
        };
        let relative = |star: &Parameters<f64>, [axis, momentum, turn]: [Vector3<f64>; 3]| {
            let turned = |v: Vector3<f64>| v.zip_map(&turn.cross(&v), Dual64::new);
            let star = star.seeded(Parameter::Rho);
            let change = strain(&star, [&turned(axis), &turned(momentum)], Observable::StrainPlus).eps;
            let momentum = momentum.map(Dual64::from_re);
            let state = |_| BodyState { axis: Vector3::z(), momentum, equatorial_axis: Vector3::x() };
            change.abs() / Term::Sample(0.0).per_radian(&star, Observable::StrainPlus, &state)
        };
        for (inertia_xx, constant_c, oblateness, size, range) in [
            (2.0, 1.0, 0.1, 30.0, 0.7..1.0),
            (0.3, -0.6, -0.2, 30.0, 0.7..1.0),
            (2.0, 7.0, 0.1, 1e-3, 0.4..0.5),
            (0.3, -0.6, -0.2, 1e-3, 0.4..0.5),
        ] {
            let mut star = stars::precessing();
            unit(&mut star, inertia_xx, constant_c, oblateness);
            let mut most = 0.0_f64;
            for _ in 0..30_000 {
                let mut vector = || Vector3::from_fn(|_, _| number()).normalize();
                let [axis, momentum, turn] = [vector(), vector() * size, vector()];
                (star.theta_o, star.phi_o) = (3.0 * number(), 3.0 * number());
                most = most.max(relative(&star, [axis, momentum, turn]));
            }
            assert!(range.contains(&most), "{most} {:?}", star.spheroid);
        }
        // Without torque, seen along L, where h_+ is zero.
        let mut star = Parameters { theta_o: 0.0, phi_o: 0.0, ..stars::precessing() };
        star.coefficients.fill(0.0);
        unit(&mut star, 2.0, 1.0, 0.1);
        let axis = Vector3::new(0.5_f64.sqrt(), 0.5_f64.sqrt(), 0.0);
        assert!((relative(&star, [axis, Vector3::z() * 30.0, Vector3::z()]) - 1.0).abs() < 1e-12);
    }

    /// Twenty times the tolerance plus the rounding of an angle of that many radians; without the latter where phases are
    /// kept.
    #[test]
    fn derivatives_have_an_error_by_the_rotation() {
        let star = stars::slow();
        let rate = star.state().momentum.norm();
        let error = |star: &Parameters<f64>, times: &[f64]| {
            jacobian(star, &[], &strain_at(star, times), &[Parameter::Spin]).expect("derivatives").relative_error
        };
        for time in [10.0, 50.0] {
            let expected = 20.0 * (1e-13 + f64::EPSILON * rate * time);
            assert!((error(&star, &[1.0, time, 3.0, time]) / expected - 1.0).abs() < 1e-12, "{time}: {expected:e}");
        }
        assert_eq!(error(&star, &[1.0, 2_000.0]), 2e-12);
        assert_eq!(error(&stars::weak(), &[1e6, 2e6]), 2e-12);
    }
}
