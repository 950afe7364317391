//! The Jacobian of data by unknowns, by exact derivatives.
//!
//! The states and their derivatives by the parameters of [`plan::gradient`](twofold::plan::gradient) come of one motion. A column
//! by an unknown is a sum of columns by such parameters, and of what is explicit in the unknown: beam, line of sight, scale.

use std::cmp::Ordering;
use std::collections::BTreeMap;

use nalgebra::{DMatrix, DVector, Matrix3};
use num_dual::Dual64;
use twofold::dynamics::wave_source::spheroid_inertia_acceleration;
use twofold::dynamics::{BodyState, RigidSpheroid};
use twofold::observables::Observer;
use twofold::observables::gravitational_wave::{metric_perturbation, polarizations};
use twofold::observables::pulsar::Beam;
use twofold::observables::pulsar::event_time::event_time;
use twofold::plan::{Gradient, Method, Output, Parameter, Plan, Request, Start, StateFunction, gradient_in_parts};
use twofold::{Error, Real};

use super::signal::ACCURACY;
use super::{Datum, Event, InferenceError, Model, Observable, Place, Unknown, long_span};

/// Derivatives of data by unknowns.
#[derive(Debug, Clone, PartialEq)]
pub struct Jacobian {
    /// A row for each datum, a column for each unknown.
    pub matrix: DMatrix<f64>,
    /// The same with the magnitudes of the terms of each sum: rounding is relative to these.
    pub magnitudes: DMatrix<f64>,
    /// Relative error of the terms.
    pub relative_error: f64,
}

/// The factor between the accuracy asked of derivatives and their error, at most: `gradient-both-ways` finds 8 in 3,000 motions.
const SAFETY: f64 = 20.0;

/// The Jacobian of `data` by `unknowns` for a model, at the pulses `events` of that model.
///
/// # Errors
/// [`InferenceError::NoPulse`] for a datum of a turn in which `events` has none; [`InferenceError::Model`] for a motion that cannot
/// be computed, and for a pulse of which the line of sight only touches the edge.
pub fn jacobian(
    model: &Model<f64>,
    events: &[Event],
    data: &[Datum],
    unknowns: &[Unknown],
) -> Result<Jacobian, InferenceError> {
    let by_turn: BTreeMap<i64, &Event> = events.iter().map(|event| (event.turn, event)).collect();
    let terms = data.iter().map(|datum| Term::of(datum, &by_turn)).collect::<Result<Vec<_>, _>>()?;
    let start = model.start();
    let (parameters, weights) = weights(model, unknowns);
    let states = States::new(model, &start, &terms, &parameters)?;
    let (rows, base) = (data.len(), parameters.len());
    // By the parameters of the motion, at constant beam and line of sight.
    let mut by_parameters = DMatrix::zeros(rows, base);
    for (column, parameter) in parameters.iter().enumerate() {
        let seeded = seeded_start(&start, *parameter);
        let fixed = model.lifted();
        for (row, (datum, term)) in data.iter().zip(&terms).enumerate() {
            let state = |t: [f64; 2]| states.at(t, Some(column));
            by_parameters[(row, column)] =
                term.value(&fixed, (&seeded.spheroid, &seeded.violation), datum.observable, &state)?.eps;
        }
    }
    // By what is explicit, at constant motion.
    let mut explicit = DMatrix::zeros(rows, unknowns.len());
    for (column, unknown) in unknowns.iter().enumerate().filter(|(_, unknown)| is_explicit(**unknown)) {
        let mut seeded = model.lifted();
        unknown.add(&mut seeded, Dual64::new(0.0, 1.0));
        let still = start.lifted();
        for (row, (datum, term)) in data.iter().zip(&terms).enumerate() {
            let state = |t: [f64; 2]| states.at(t, None);
            explicit[(row, column)] =
                term.value(&seeded, (&still.spheroid, &still.violation), datum.observable, &state)?.eps;
        }
    }
    // The averaged motion keeps its phases in 32 digits.
    let rotation = if states.is_long { 0.0 } else { 1.0 } * states.end() * start.state().momentum.norm()
        / start.spheroid.inertia_xx;
    let found = Jacobian {
        matrix: &by_parameters * &weights + &explicit,
        magnitudes: by_parameters.abs() * weights.abs() + explicit.abs(),
        relative_error: SAFETY * (ACCURACY + f64::EPSILON * rotation),
    };
    match found.matrix.iter().find(|value| !value.is_finite()) {
        Some(&value) => {
            let (quantity, allowed) = ("derivative of a datum", "a finite number: no touch of the edge of the beam");
            Err(Error::Domain { quantity, value, allowed }.into())
        }
        None => Ok(found),
    }
}

/// Whether data depend on it beside the motion.
fn is_explicit(unknown: Unknown) -> bool {
    unknown.is_of_beam() || matches!(unknown, Unknown::ThetaO | Unknown::PhiO | Unknown::StrainScale)
}

/// The parameters of the motion that unknowns change, and for each of these (a row) by how much with each unknown (a column).
fn weights(model: &Model<f64>, unknowns: &[Unknown]) -> (Vec<Parameter>, DMatrix<f64>) {
    let mut all = DMatrix::zeros(Parameter::COUNT, unknowns.len());
    for (column, unknown) in unknowns.iter().enumerate() {
        let mut seeded = model.lifted::<Dual64>();
        unknown.add(&mut seeded, Dual64::new(0.0, 1.0));
        let start = seeded.start();
        for (row, parameter) in Parameter::ALL.iter().enumerate() {
            all[(row, column)] = part(&start, *parameter).eps;
        }
    }
    let used: Vec<usize> = (0..Parameter::COUNT).filter(|row| all.row(*row).amax() > 0.0).collect();
    (used.iter().map(|row| Parameter::ALL[*row]).collect(), all.select_rows(&used))
}

/// A parameter of a start.
fn part<S: Copy>(start: &Start<S>, parameter: Parameter) -> S {
    let Start { spheroid, violation, angles, rates } = start;
    match parameter {
        Parameter::InertiaXx => spheroid.inertia_xx,
        Parameter::InertiaZz => spheroid.inertia_zz,
        Parameter::ConstantC => spheroid.constant_c,
        Parameter::S(i, j) => violation[(i, j)],
        Parameter::Alpha => angles.alpha,
        Parameter::Beta => angles.beta,
        Parameter::Gamma => angles.gamma,
        Parameter::AlphaRate => rates.alpha,
        Parameter::BetaRate => rates.beta,
        Parameter::GammaRate => rates.gamma,
    }
}

fn seeded_start(start: &Start<f64>, parameter: Parameter) -> Start<Dual64> {
    let mut seeded = start.lifted();
    parameter.add(&mut seeded, Dual64::new(0.0, 1.0));
    seeded
}

/// `n`, `L` and `e_x`.
struct Vectors;

impl StateFunction for Vectors {
    fn len(&self) -> usize {
        9
    }

    fn values<S: Real>(&self, _: &RigidSpheroid<S>, _: &Matrix3<S>, state: &BodyState<S>, values: &mut [S]) {
        let all = state.axis.iter().chain(&state.momentum).chain(&state.equatorial_axis);
        values.iter_mut().zip(all).for_each(|(value, component)| *value = *component);
    }
}

/// Times in two parts, in some order.
fn order(a: &[f64; 2], b: &[f64; 2]) -> Ordering {
    a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1]))
}

/// States with derivatives at the times of the data.
struct States {
    times: Vec<[f64; 2]>,
    found: Gradient,
    is_long: bool,
}

impl States {
    fn new(model: &Model<f64>, start: &Start<f64>, terms: &[Term], parameters: &[Parameter]) -> Result<Self, Error> {
        let mut times: Vec<[f64; 2]> = terms.iter().flat_map(|term| term.times()).collect();
        times.sort_by(order);
        times.dedup();
        let end = times.iter().fold(0.0, |last: f64, [epoch, t]| last.max(epoch + t));
        let is_long = long_span::is_long(model, end);
        let needs_beam = terms.iter().any(|term| !matches!(term, Term::Sample(_)));
        let output = if needs_beam { Output::PulseProfile } else { Output::GravitationalWave };
        let request = Request {
            derivatives: parameters.to_vec(),
            method: is_long.then_some(Method::Averaged),
            ..Request::new(&[output], (0.0, end), times.len(), ACCURACY)
        };
        let plan = Plan::from_parts(&start.spheroid, &start.violation, &start.state(), &request)?;
        let found = gradient_in_parts(&plan, start, &Vectors, &times)?;
        Ok(Self { times, found, is_long })
    }

    /// The last time.
    fn end(&self) -> f64 {
        self.times.iter().fold(0.0, |last, [epoch, t]| last.max(epoch + t))
    }

    /// The state at a time with its derivative by the parameter with a number, or with none.
    fn at(&self, t: [f64; 2], parameter: Option<usize>) -> BodyState<Dual64> {
        let row = self.times.partition_point(|time| order(time, &t).is_lt());
        let component = |place: usize| {
            let derivative = parameter.map_or(0.0, |column| self.found.jacobians[row][(place, column)]);
            Dual64::new(self.found.values[(row, place)], derivative)
        };
        let vector = |first: usize| nalgebra::Vector3::from_fn(|i, _| component(first + i));
        BodyState { axis: vector(0), momentum: vector(3), equatorial_axis: vector(6) }
    }
}

/// What a datum is a function of.
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
        match datum.place {
            Place::Time(t) => Ok(Self::Sample(t)),
            Place::Turn { number, near } => {
                let event = |turn: i64| {
                    events.get(&turn).copied().copied().ok_or(InferenceError::NoPulse { turn: number, near })
                };
                let here = event(number)?;
                Ok(match datum.observable {
                    Observable::Periods => Self::Pulses(event(number - 1)?, here),
                    _ => Self::Pulse(here),
                })
            }
        }
    }

    fn times(&self) -> Vec<[f64; 2]> {
        match self {
            Self::Pulse(event) => {
                let sought = [event.start, event.end, event.closest].into_iter().filter(|t| t.is_finite());
                sought.map(|t| [event.epoch, t]).collect()
            }
            Self::Pulses(before, event) => {
                let of = |event: &Event| [[event.epoch, event.start], [event.epoch, event.end]];
                [of(before), of(event)].concat()
            }
            Self::Sample(t) => vec![[*t, 0.0]],
        }
    }

    /// The datum as a function of one parameter.
    fn value(
        &self,
        model: &Model<Dual64>,
        (spheroid, s): (&RigidSpheroid<Dual64>, &Matrix3<Dual64>),
        observable: Observable,
        state: &impl Fn([f64; 2]) -> BodyState<Dual64>,
    ) -> Result<Dual64, Error> {
        let observer: Observer<Dual64> = model.observer();
        let beam: Beam<Dual64> = model.beam();
        let n = &observer.direction;
        let margin = |event: &Event, t: f64| beam.margin_rates(spheroid, s, &state([event.epoch, t]), n);
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
                let acceleration = spheroid_inertia_acceleration(spheroid, s, &axis, &momentum);
                let h = polarizations(&observer, &metric_perturbation(Dual64::from_re(1.0), &acceleration));
                let h = if observable == Observable::StrainPlus { h.plus } else { h.cross };
                Ok(h * model.strain_scale * model.strain_unit)
            }
        }
    }
}

impl Jacobian {
    /// With each row divided by the standard deviation of its datum.
    pub fn weighted(&self, data: &[Datum]) -> Self {
        let weights = DVector::from_iterator(data.len(), data.iter().map(|datum| 1.0 / datum.sigma));
        let weighted = |matrix: &DMatrix<f64>| {
            let mut matrix = matrix.clone();
            matrix.row_iter_mut().zip(&weights).for_each(|(mut row, weight)| row *= *weight);
            matrix
        };
        Self {
            matrix: weighted(&self.matrix),
            magnitudes: weighted(&self.magnitudes),
            relative_error: self.relative_error,
        }
    }
}
