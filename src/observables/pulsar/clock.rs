//! A pulsar as a clock: its pulse near any time, with turns counted continuously however many there are. Eqs. (44), (47).

use core::f64::consts::{FRAC_PI_2, PI, TAU};

use nalgebra::{Matrix3, Rotation3, Unit};

use super::azimuth_follower::phase;
use super::edge_search::{EdgeSearch, Event};
use super::margin::{ByStates, Margin};
use super::position_angle::{position_angle, position_angle_rate};
use super::rate_bounds::{RateBounds, rate_bounds};
use super::swing::swing;
use super::timing_model::{TimingModel, TimingParameter::*, azimuth_ahead};
use super::train::{PulseTrain, check_beam};
use super::turn_count::{Look, TurnCount};
use super::{Beam, Pulse};
use crate::dynamics::bulge::kinematic_momentum;
use crate::dynamics::equations_of_motion::angular_velocity;
use crate::dynamics::{BodyState, RigidSpheroid, RotationState};
use crate::error::Error;
use crate::numerics::angle::{about, between, wrapped};
use crate::numerics::double_double::DoubleDouble;
use crate::observables::Observer;
use crate::observables::spectrum::QuasiPeriodicMotion;
use crate::propagation::{Motion, PhasedMotion, Turning, largest_torque};
use crate::spin_down::{Braking, Precession, StretchedTime};

/// Largest `x = C |s| I^xx / |L|^2` allowed for a torque that depends on the magnetic axis. The two harmonics of the torque are computed for free
/// precession with the initial angles, which is accurate to `x`.
const STRONGEST: f64 = 1e-3;

/// Largest rotation of the body in one turn about L (rad); the search then takes a tenth of a second.
const MOST_ROTATION: f64 = 1e5;

/// A pulsar with its motion, its beam and its observer.
///
/// ```
/// use nalgebra::{Matrix3, Vector3};
/// use twofold::dynamics::{BodyState, Problem, RigidSpheroid};
/// use twofold::observables::Observer;
/// use twofold::observables::pulsar::{Beam, PulsarClock};
/// use twofold::propagation::PhasedMotion;
///
/// // 641.9 turns in a second about Z, without Lorentz violation; the unit of time is the second.
/// let spheroid = RigidSpheroid { inertia_xx: 1.0, inertia_zz: 1.001, constant_c: 1.0e5 };
/// let spin = 4033.0;
/// let start = BodyState { axis: Vector3::z(), momentum: Vector3::z() * (1.001 * spin), equatorial_axis: Vector3::x() };
/// let (beam, observer) = (Beam::new(1.3, 0.0, 0.15), Observer::at(1.35, 0.0));
/// let problem = Problem::new(spheroid, Matrix3::zeros(), start)?;
/// let clock = PulsarClock::new(PhasedMotion::averaged(&problem)?, &beam, &observer)?;
/// let pulse = clock.pulse_near([4.7e8, 0.0])?.expect("a pulse in every turn");
/// assert_eq!(pulse.number, (4.7e8 * spin / core::f64::consts::TAU).round() as i64);
/// # Ok::<(), twofold::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct PulsarClock {
    motion: PhasedMotion,
    /// In stretched time the star does not slow down.
    time: StretchedTime,
    beam: Beam<f64>,
    observer: Observer<f64>,
    bounds: RateBounds,
    turns: TurnCount,
}

/// A pulse of a [`PulsarClock`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClockPulse {
    /// Number of the turn to which the pulse belongs. The turns are those of the magnetic axis about the angular momentum, relative
    /// to the line of sight; the turn nearest to the time zero has the number zero.
    pub number: i64,
    /// Midpoint between the edges, as the unevaluated sum of two doubles, with 32 digits.
    pub midpoint: [f64; 2],
    /// Time between the edges.
    pub duration: f64,
    /// Position angle (rad) of the magnetic axis at the midpoint, from -pi to pi; NaN where the axis is along the line of
    /// sight.
    pub position_angle: f64,
    /// Rate of the position angle there (rad per unit of time).
    pub position_angle_rate: f64,
    /// Swing of the position angle from edge to edge (rad), followed along the pulse.
    pub swing: f64,
    /// State at the midpoint, in the frame of the initial state.
    pub state: BodyState<f64>,
}

/// The motion near a time, in stretched time.
struct Near<'a> {
    clock: &'a PulsarClock,
    t: [f64; 2],
}

impl Near<'_> {
    fn stretched(&self, since: f64) -> DoubleDouble {
        DoubleDouble::from(self.t) + since.into()
    }

    fn at(&self, since: f64) -> BodyState<f64> {
        self.clock.state(self.stretched(since).into())
    }
}

impl Motion<f64> for Near<'_> {
    type State = BodyState<f64>;

    fn spheroid(&self) -> &RigidSpheroid<f64> {
        self.clock.motion.problem.spheroid()
    }

    fn coefficients(&self) -> &Matrix3<f64> {
        self.clock.motion.problem.coefficients()
    }

    fn span(&self) -> (f64, f64) {
        (f64::NEG_INFINITY, f64::INFINITY)
    }

    fn state(&self, t: f64) -> Result<BodyState<f64>, Error> {
        Ok(self.at(t))
    }

    fn error_estimate(&self, t: f64) -> f64 {
        self.clock.motion.error_estimate(self.t[0] + t)
    }

    fn turning(&self) -> Turning<'_> {
        Turning::Equations { bulge: self.clock.motion.problem.bulge() }
    }
}

impl PulsarClock {
    /// The clock of a pulsar with this motion. The `observer` is given in the inertial frame of the motion.
    ///
    /// # Errors
    /// [`Error::Domain`] as for [`pulse_train`](super::pulse_train), if the line of sight or the magnetic axis comes to lie along L, about which
    /// turns are counted, and for a body that turns by more than 1e5 rad in one such turn.
    pub fn new(motion: PhasedMotion, beam: &Beam<f64>, observer: &Observer<f64>) -> Result<Self, Error> {
        check_beam(beam, &observer.direction)?;
        let turns = TurnCount::new(&motion, beam, &observer.direction)?;
        let problem = &motion.problem;
        let bounds = rate_bounds(problem.spheroid(), problem.coefficients(), problem.bulge(), problem.initial());
        let rotation = TAU * bounds.first / turns.rate(&motion);
        Error::ensure(
            (0.0..=MOST_ROTATION).contains(&rotation),
            "rotation (rad) of the body in a turn of the magnetic axis about L",
            rotation,
            "above zero and at most 1e5; all of it is searched for pulses",
        )?;
        Ok(Self { bounds, turns, time: StretchedTime::uniform(), motion, beam: *beam, observer: *observer })
    }

    /// The pulsar slowing down under a torque along `L`. At the time zero its mean rotation is that of the motion. `C` falls with the square of the
    /// rotation rate, as for a centrifugal bulge.
    ///
    /// # Errors
    /// As for [`StretchedTime::new`]; [`Error::Domain`] for a torque that depends on the magnetic axis where `C |s| I^xx / |L|^2` is above
    /// 1e-3.
    pub fn braked(self, braking: &Braking) -> Result<Self, Error> {
        if braking.torque_share > 0.0 {
            self.require_weak("C |s| I^xx / |L|^2 with a torque that goes with the magnetic axis")?;
        }
        let time = StretchedTime::new(braking, &self.precession(self.time.precession().damping)?)?;
        Ok(Self { time, ..self })
    }

    /// The pulsar with internal friction that damps the wobble at a `rate` (1 per unit of time): see [`Precession`]. Relative to the undamped motion,
    /// `n` is tilted towards `L`, and the phase of the body about `n` is advanced.
    ///
    /// # Errors
    /// As for [`StretchedTime::new`]; [`Error::Domain`] where `C |s| I^xx / |L|^2` is above 1e-3.
    pub fn damped(self, rate: f64) -> Result<Self, Error> {
        self.require_weak("C |s| I^xx / |L|^2 with damping of the wobble")?;
        let time = StretchedTime::new(self.time.braking(), &self.precession(rate)?)?;
        Ok(Self { time, ..self })
    }

    fn require_weak(&self, with: &'static str) -> Result<(), Error> {
        Error::ensure(self.strength() <= STRONGEST, with, self.strength(), "at most 1e-3")
    }

    /// The free precession of the state at the time zero.
    fn precession(&self, damping: f64) -> Result<Precession, Error> {
        let state = self.motion.problem.initial();
        let (n, l) = (state.axis, state.momentum.normalize());
        let m = self.beam.direction(state);
        let [wobble, chi] = [l, m].map(|v| between(&n, &v));
        let phase = about(&n, &(m - n * n.dot(&m)), &l);
        // The magnetic axis rotates about n like e_x, and psi is the angle from it to L.
        Ok(Precession::new([wobble, chi, phase], -self.precession_rates()?[0], damping))
    }

    /// The star as a [`TimingModel`], which has free precession and a line of sight whose angle to `L` changes linearly. It is accurate to
    /// `x = C |s| I^xx / |L|^2` in angles, over times in which `L` turns by a small angle. Where `n` is more than a right angle from `L`, as for a
    /// star of negative spin, the angles of the model are counted from `-n`.
    ///
    /// # Errors
    /// As for [`TimingModel::new`] and [`precession_rates`](Self::precession_rates).
    pub fn timing_model(&self) -> Result<TimingModel, Error> {
        let Precession { wobble, chi, phase, rate: precession_rate, damping, .. } =
            about_nearer_end(&self.precession(self.time.precession().damping)?);
        let Braking { rate, index, torque_share } = *self.time.braking();
        let frequency = self.turns.per_time(&self.motion);
        let f1 = -rate * frequency.high;
        let [inclination, inclination_rate] = self.inclination()?;
        let parameters = [
            (F1, f1),
            (F2, index * f1 * f1 / frequency.high),
            (Wobble, wobble),
            (Chi, chi),
            (PrecessionPhase, phase),
            (PrecessionRate, precession_rate),
            (TorqueShare, torque_share),
            (Inclination, inclination),
            (InclinationRate, inclination_rate),
            (Rho, self.beam.half_opening),
            (Damping, damping),
        ];
        let model = TimingModel::new(frequency.into(), &parameters)?;
        let look = self.turns.look(&self.motion, [0.0; 2])?;
        // Less than half a turn from the mean.
        let at_zero = model.phase([0.0; 2])?.fraction;
        model.moved(&[(Phase, look.phase / TAU - at_zero)])
    }

    /// Angle of the line of sight to `L` at the time zero, and its mean rate over the time in which `L` turns by a hundredth of a radian about its
    /// axis.
    fn inclination(&self) -> Result<[f64; 2], Error> {
        let angle = |t: f64| between(&self.motion.state([t, 0.0]).momentum, &self.observer.direction);
        let rate = self.precession_rates()?[1].abs();
        let half = 0.005 / rate;
        Ok([angle(0.0), if rate > 0.0 { (angle(half) - angle(-half)) / (2.0 * half) } else { 0.0 }])
    }

    /// The motion; for a star that slows down, in stretched time.
    pub fn motion(&self) -> &PhasedMotion {
        &self.motion
    }

    /// Mean rates (rad per unit of time) of two precessions. The first is free precession: the rotation of `e_x` about `n`, relative to the direction
    /// in which `n` circles `L`. The second is the precession of `L`. It is positive where `L` circles a principal axis of `s^IJ` in the right-handed
    /// sense, with the axis directed so that its largest component in the frame of the initial state is positive. It is zero where `L` stays fixed.
    ///
    /// # Errors
    /// As for [`QuasiPeriodicMotion::new`]; [`Error::Unsupported`] if the turns about `n` or of `L` cannot be counted.
    pub fn precession_rates(&self) -> Result<[f64; 2], Error> {
        if let Some(of_momentum) = self.motion.precession_of_momentum() {
            let [.., of_body] = self.motion.rates();
            return Ok([of_body, of_momentum]);
        }
        let motion = QuasiPeriodicMotion::new(&self.motion.problem)?;
        let rate = |symbol: &str, what| {
            let rate = motion.frequencies().rate(symbol);
            rate.ok_or(Error::not_found(what))
        };
        Ok([rate("psi'", "turns of the body about its axis")?, rate("l'", "turns of L about its axis")?])
    }

    /// The stretched time of the motion.
    pub fn stretched_time(&self) -> &StretchedTime {
        &self.time
    }

    /// Mean time between two pulses; for a star that slows down, its value at the time zero. It is positive because turns
    /// are counted about `L`.
    pub fn period(&self) -> f64 {
        TAU / self.turns.rate(&self.motion)
    }

    /// Error of a midpoint at the time `t` because of effects that the motion neglects: the error of directions over the rotation rate. For a star
    /// that slows down it includes the truncation of the stretched time, the effect of angle errors of `C |s| I^xx / |L|^2` on the timing delay due
    /// to the torque modulation, and the effect of treating `C` as constant on the precession of `L`. For a damped wobble it includes the change,
    /// with the wobble, of the rates due to `C`.
    pub fn truncation(&self, t: f64) -> f64 {
        let of_motion = self.motion.truncation(t) / self.turns.rate(&self.motion);
        if self.time.is_uniform() && self.time.precession().damping == 0.0 {
            return of_motion;
        }
        let state = self.motion.problem.initial();
        let precession = self.strength() * state.momentum.norm() / self.motion.problem.spheroid().inertia_xx;
        let slowed = self.time.braking().rate * t * t;
        // The rates due to a rigid C vary with the square of the wobble: that of L by 3 / 2 of it, that about n by less than 3 / 2. The error of the
        // tilt is that of a wobble accurate to the strength.
        let wobble = self.time.precession().wobble;
        let now = self.time.precession().wobble_at(t);
        let damped = 3.0 * (now.sin().powi(2) - wobble.sin().powi(2)) * t;
        let tilt = self.strength() * (now - wobble).abs();
        let rigid = (precession * (slowed.abs() + damped.abs()) + tilt) / self.turns.rate(&self.motion);
        of_motion + self.time.truncation(t) + self.time.error_by_angles(self.strength()) + rigid
    }

    /// `C |s| I^xx / |L|^2`, from the largest torque: the relative effect of Lorentz violation on rates.
    fn strength(&self) -> f64 {
        let problem = &self.motion.problem;
        let torque = largest_torque(problem.spheroid(), problem.coefficients());
        torque * problem.spheroid().inertia_xx / problem.initial().momentum.norm_squared()
    }

    /// Returns the state as a function of the time since `t[0] + t[1]`, in the frame of the initial state.
    ///
    /// # Errors
    /// The function returns the errors of [`StretchedTime::stretched_at`].
    pub fn near(&self, t: [f64; 2]) -> impl Fn(f64) -> Result<BodyState<f64>, Error> {
        let near = DoubleDouble::from(t);
        move |since| {
            let tau = self.time.stretched_at((near + since.into()).into())?;
            Ok(self.slowed(self.state(tau), tau[0]))
        }
    }

    /// The state at a stretched time, with the damped wobble but without braking.
    fn state(&self, tau: [f64; 2]) -> BodyState<f64> {
        let state = self.motion.state(tau);
        let precession = self.time.precession();
        let across = state.axis.cross(&state.momentum);
        let (Some(across), true) = (Unit::try_new(across, 0.0), precession.damping != 0.0) else { return state };
        let towards = Rotation3::from_axis_angle(&across, precession.wobble - precession.wobble_at(tau[0]));
        let axis = towards * state.axis;
        let on = Rotation3::from_axis_angle(&Unit::new_unchecked(axis), -precession.ahead(tau[0]));
        BodyState { axis, equatorial_axis: on * (towards * state.equatorial_axis), ..state }
    }

    /// The turn at a stretched time.
    fn look(&self, tau: [f64; 2]) -> Result<Look, Error> {
        let look = self.turns.look(&self.motion, tau)?;
        let precession = self.time.precession();
        if precession.damping == 0.0 {
            return Ok(look);
        }
        let sight = &self.observer.direction;
        let damped = phase(&self.beam, sight, &self.state(tau))?;
        // The difference of the phases in free precession determines the whole turns.
        let precession = &about_nearer_end(precession);
        let ahead = precession.ahead(tau[0]);
        let psi = precession.phase_at(tau[0]);
        let azimuth = |wobble: f64, psi: f64| azimuth_ahead(wobble, precession.chi, psi);
        let change = azimuth(precession.wobble_at(tau[0]), psi) - azimuth(precession.wobble, psi - ahead) - ahead;
        let counted = look.phase + change;
        let turned = counted + wrapped(damped - counted);
        let phase = wrapped(turned);
        Ok(Look { number: look.number + ((turned - phase) / TAU).round() as i64, phase })
    }

    /// A state of the motion with `L` reduced to its value at a stretched time.
    fn slowed(&self, state: BodyState<f64>, tau: f64) -> BodyState<f64> {
        BodyState { momentum: state.momentum * self.time.slowing(tau), ..state }
    }

    /// The pulse of the turn nearest to the time `t[0] + t[1]`; if that turn has several, the one nearest to its middle. `None` if the
    /// turn has no pulse, or if an edge of the pulse is farther than a turn and a half from the middle of the turn. The cost does not
    /// depend on `t`.
    ///
    /// A pulse is an interval of time with `m.n > cos rho`. The search takes derivatives and their bounds from the exact equations of motion; those
    /// of an averaged motion differ by `x^2`, with `x = C |s| I^xx / |L|^2`, as the averaged motion itself does. For `x` below 1e-6, and for exact
    /// motion, edges are as accurate as those of [`pulse_train`](super::pulse_train), otherwise to some `1e-4 x^2` rad.
    ///
    /// # Errors
    /// [`Error::Domain`] for times that are not finite, after 4e18 turns, and as for [`StretchedTime::stretched_at`].
    pub fn pulse_near(&self, t: [f64; 2]) -> Result<Option<ClockPulse>, Error> {
        Error::ensure((t[0] + t[1]).is_finite(), "time t", t[0] + t[1], "a finite number")?;
        // If the parts are much larger than their sum, they would not resolve turns.
        let t = self.time.stretched_at(DoubleDouble::sum(t[0], t[1]).into())?;
        let look = self.look(t)?;
        let period = self.period();
        let middle = -look.phase / self.turns.rate(&self.motion);
        let near = Near { clock: self, t };
        let margin = ByStates {
            motion: &near,
            turning: near.turning(),
            beam: &self.beam,
            line_of_sight: &self.observer.direction,
        };
        let search = EdgeSearch::new(margin, self.bounds);
        if let Some(pulse) = around(&search, middle, period)? {
            return Ok(Some(self.described(&near, look.number, &pulse)));
        }
        for reach in [0.5, 1.5] {
            let train = search.train(middle - reach * period, middle + reach * period)?;
            match nearest(&train, middle) {
                Some(pulse) if pulse.is_whole() => return Ok(Some(self.described(&near, look.number, &pulse))),
                Some(_) => {}
                None => return Ok(None),
            }
        }
        Ok(None)
    }

    fn described(&self, near: &Near<'_>, number: i64, pulse: &Pulse) -> ClockPulse {
        let time_at = |since: f64| DoubleDouble::from(self.time.time_at(near.stretched(since).into()));
        let (start, end) = (time_at(pulse.start), time_at(pulse.end));
        let midpoint = (start + end) * 0.5;
        // For a star that slows down it is not the middle of the stretched time, but so near that one step of Newton's method reaches it.
        let late = midpoint - time_at(pulse.midpoint());
        let middle = near.stretched(pulse.midpoint());
        let stretched = middle + (late.high * self.time.slowing(middle.high)).into();
        let state = self.state(stretched.into());
        let bulge = self.motion.problem.bulge();
        let momentum = kinematic_momentum(near.spheroid(), near.coefficients(), bulge, &state.axis_state());
        let omega = angular_velocity(near.spheroid(), &state.axis, &momentum);
        let m = self.beam.direction(&state);
        let psi = position_angle(&m, &self.observer).unwrap_or(f64::NAN);
        let rate = if psi.is_nan() { psi } else { position_angle_rate(&m, &omega, &self.observer) };
        // Friction that damps the wobble may add a tenth to the rates.
        let second = 1.25 * self.bounds.second;
        let direction = |since: f64| self.beam.direction(&near.at(since));
        ClockPulse {
            number,
            midpoint: midpoint.into(),
            duration: (end - start).high,
            position_angle: psi,
            position_angle_rate: rate * self.time.slowing(stretched.high),
            swing: swing(direction, second, &self.observer, (pulse.start, pulse.end)),
            state: self.slowed(state, stretched.high),
        }
    }
}

/// The pulse at a time, if the line of sight is inside the beam then and m.n is concave: no other pulse is nearer, and the rest of the
/// turn need not be searched.
fn around<P: Margin>(search: &EdgeSearch<P>, time: f64, period: f64) -> Result<Option<Pulse>, Error> {
    let middle = search.jet(time)?;
    let [margin, _, curvature, _] = middle.values;
    if margin <= 0.0 || curvature >= 0.0 {
        return Ok(None);
    }
    let reach = (1.25 * (-2.0 * margin / curvature).sqrt()).min(0.5 * period);
    let (before, after) = (search.jet(time - reach)?, search.jet(time + reach)?);
    let (mut start, mut end) = (None, None);
    search.piece(&before, &middle, &mut |event| {
        if let Event::Crossing { time, entering } = event {
            start = entering.then_some(time);
        }
    })?;
    search.piece(&middle, &after, &mut |event| {
        if let Event::Crossing { time, entering: false } = event {
            end.get_or_insert(time);
        }
    })?;
    let whole = start.zip(end);
    Ok(whole.map(|(start, end)| Pulse { start, end, cut_at_start: false, cut_at_end: false }))
}

/// The pulse that contains a time or is nearest to it.
fn nearest(train: &PulseTrain, time: f64) -> Option<Pulse> {
    let distance = |pulse: &Pulse| (pulse.start - time).max(time - pulse.end).max(0.0);
    train.pulses.iter().min_by(|a, b| distance(a).total_cmp(&distance(b))).copied()
}

/// The same precession with the end of the symmetry axis that is nearer to `L` as `n`: angles about `n` have the opposite sign.
fn about_nearer_end(precession: &Precession) -> Precession {
    let Precession { wobble, chi, phase, rate, damping, .. } = *precession;
    if wobble > FRAC_PI_2 { Precession::new([PI - wobble, PI - chi, -phase], -rate, damping) } else { *precession }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;
    use crate::dynamics::Problem;
    use crate::observables::pulsar::margin::tests::search_of;

    #[test]
    fn the_pulse_that_holds_a_time_is_found_where_the_margin_bends_downwards() {
        let around =
            |edge: f64, time: f64, period: f64| around(&search_of(vec![[1.0, 1.0, 0.0]], edge), time, period).unwrap();
        for time in [-0.15, 0.02, 0.1] {
            let pulse = around(0.5, time, TAU).expect("a pulse");
            assert!((pulse.start + PI / 3.0).abs() < 1e-14 && (pulse.end - PI / 3.0).abs() < 1e-14, "{pulse:?}");
            assert!(!pulse.cut_at_start && !pulse.cut_at_end);
        }
        // Outside the beam, inside it where m.n is convex, and over more than a period.
        assert_eq!(around(0.5, 1.2, TAU), None);
        assert_eq!(around(-0.5, 1.8, 2.0 * TAU), None);
        assert_eq!(around(0.5, 0.0, 2.0), None);
        assert!(around(0.5, 0.0, 2.2).is_some());
    }

    /// A star without Lorentz violation that wobbles by 0.5 rad about L, once in four and a half turns. The magnetic axis is 0.3 rad from the
    /// symmetry axis, and its angle to L is between 0.2 and 0.8; the observer is next to L, inside the beam for the part of a wobble with a smaller
    /// angle.
    fn wobbling(half_opening: f64) -> PulsarClock {
        let spheroid = RigidSpheroid { inertia_xx: 1.0, inertia_zz: 0.8, constant_c: 1.0 };
        let (sin, cos) = 0.5_f64.sin_cos();
        let axis = Vector3::new(sin, 0.0, cos);
        let start = BodyState { axis, momentum: Vector3::z(), equatorial_axis: Vector3::y() };
        let beam = Beam::new(0.3, 0.4, half_opening);
        let observer = Observer::at(0.01, 0.0);
        let problem = Problem::new(spheroid, Matrix3::zeros(), start).unwrap();
        PulsarClock::new(PhasedMotion::averaged(&problem).unwrap(), &beam, &observer).unwrap()
    }

    #[test]
    fn a_pulse_is_not_given_where_it_lasts_over_more_turns_than_are_searched() {
        // The fraction of a wobble with an angle to L below this.
        let (theta, chi) = (0.5_f64, 0.3_f64);
        let share = |half_opening: f64| {
            let cos = (theta.cos() * chi.cos() - half_opening.cos()) / (theta.sin() * chi.sin());
            1.0 - cos.acos() / PI
        };
        let wobble = TAU / (0.25 * theta.cos());
        for (half_opening, is_given) in [(0.3, true), (0.75, false)] {
            let clock = wobbling(half_opening);
            assert!((clock.period() - TAU).abs() < 1e-12);
            let duration = share(half_opening) * wobble;
            // Shorter than one turn, or longer than three.
            assert!(if is_given { duration < 0.9 * TAU } else { duration > 3.3 * TAU });
            let pulses: Vec<_> = (0..40).filter_map(|k| clock.pulse_near([0.5 * f64::from(k), 0.0]).unwrap()).collect();
            assert_eq!(!pulses.is_empty(), is_given, "{half_opening}: {pulses:?}");
            for pulse in pulses {
                assert!((pulse.duration / duration - 1.0).abs() < 0.1, "{pulse:?} {duration}");
            }
        }
    }

    /// A body with a huge moment of inertia about n turns back about n by nearly as much as n circles L. One turn of the magnetic axis about L
    /// takes `cot(theta / 2)` such turns.
    #[test]
    fn a_magnetic_axis_that_hardly_turns_is_refused() {
        let spheroid = RigidSpheroid { inertia_xx: 1.7, inertia_zz: 1e14, constant_c: 1.0 };
        for (theta, is_refused) in [(1.2e-4_f64, true), (1.3e-4, false)] {
            let axis = Vector3::new(theta.sin(), 0.0, theta.cos());
            let start = BodyState { axis, momentum: Vector3::z() * 0.8, equatorial_axis: Vector3::y() };
            let (beam, observer) = (Beam::new(1.2, 0.4, 0.3), Observer::at(1.1, 0.0));
            let problem = Problem::new(spheroid, Matrix3::zeros(), start).unwrap();
            let clock = PulsarClock::new(PhasedMotion::averaged(&problem).unwrap(), &beam, &observer);
            assert_eq!(clock.is_err(), is_refused, "{theta}: {:?}", clock.err());
            if let Err(Error::Domain { quantity, value, .. }) = clock {
                let rotation = TAU / (theta / 2.0).tan();
                assert!(
                    quantity.starts_with("rotation") && (value / rotation - 1.0).abs() < 1e-4,
                    "{value} {rotation}"
                );
            }
        }
    }

    /// A star that wobbles by 0.2 rad, with `C |s| I^xx / |L|^2` of this size; `s^IJ` is symmetric about Z, and `L` is 0.5 rad from Z.
    fn precessing(strength: f64) -> PulsarClock {
        let spheroid = RigidSpheroid { inertia_xx: 1.3, inertia_zz: 1.313, constant_c: 0.8 };
        let l = Vector3::new(0.3_f64.cos() * 0.5_f64.sin(), 0.3_f64.sin() * 0.5_f64.sin(), 0.5_f64.cos());
        let across = l.cross(&Vector3::new(0.1, 0.9, -0.2)).normalize();
        let axis = Rotation3::from_axis_angle(&Unit::new_unchecked(across), 0.2) * l;
        let start = BodyState { axis, momentum: l * 1.7, equatorial_axis: across };
        let size = strength * 1.7 * 1.7 / (0.8 * 1.3);
        let s = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, -2.0)) * (size / 12_f64.sqrt());
        let problem = Problem::new(spheroid, s, start).unwrap();
        let motion = PhasedMotion::averaged(&problem).unwrap();
        PulsarClock::new(motion, &Beam::new(1.1, 0.4, 0.3), &Observer::at(1.2, -0.5)).unwrap()
    }

    /// The star emits the same pulses later and later: rates are smaller and pulses longer by the rate of the stretched time.
    #[test]
    fn pulses_of_a_braked_star_are_those_of_the_free_one_at_the_stretched_time() {
        let free = precessing(5e-4);
        let clock = free.clone().braked(&Braking { rate: 1e-4, index: 3.0, torque_share: 0.5 }).unwrap();
        let stretched = |t: f64| clock.stretched_time().stretched_at([t, 0.0]).unwrap()[0];
        let mut compared = 0;
        // The wobble moves the beam out of sight and back.
        for t in (-18..=18).map(|k| 50.0 * f64::from(k)) {
            let Some(pulse) = clock.pulse_near([t, 0.0]).unwrap() else { continue };
            let middle = pulse.midpoint[0];
            let slowing = (stretched(middle + 0.5) - stretched(middle - 0.5)).abs();
            let freely = free.pulse_near([stretched(middle), 0.0]).unwrap().expect("a pulse");
            assert_eq!(pulse.number, freely.number);
            for (found, expected) in [
                (pulse.position_angle_rate, freely.position_angle_rate * slowing),
                (pulse.duration, freely.duration / slowing),
            ] {
                assert!((found / expected - 1.0).abs() < 1e-3, "{t}: {found:e} {expected:e}");
            }
            compared += usize::from((slowing - 1.0).abs() > 0.02);
        }
        assert!(compared > 3, "{compared}");
    }

    /// The truncation is that of the motion; for a star that is braked, whose wobble is damped or excited, or both, the terms are written out with
    /// the numbers of this star.
    #[test]
    fn what_a_clock_leaves_out() {
        let strength = 5e-4;
        let turns = TAU / precessing(strength).period();
        let of = |braking: f64, damping: f64| {
            let clock = precessing(strength).damped(damping).unwrap();
            clock.braked(&Braking { rate: braking, index: 3.0, torque_share: 0.5 }).unwrap()
        };
        for (braking, damping) in [(1e-6, 0.0), (-1e-6, 0.0), (0.0, 2e-4), (0.0, -2e-4), (1e-6, 2e-4), (-3e-6, -1e-4)] {
            let clock = of(braking, damping);
            for t in [-1e3, 2e3] {
                let of_motion = clock.motion.truncation(t) / turns;
                let wobble = (0.2_f64.tan() * f64::exp(-damping * t)).atan();
                let damped = (3.0 * t * (wobble.sin().powi(2) - 0.2_f64.sin().powi(2))).abs();
                // L precesses at about strength |L| / I^xx.
                let precessed = strength * 1.7 / 1.3 * ((braking * t * t).abs() + damped);
                let rigid = (precessed + strength * (wobble - 0.2).abs()) / turns;
                let of_time = clock.time.truncation(t) + clock.time.error_by_angles(strength);
                let expected = of_motion + of_time + rigid;
                let found = clock.truncation(t);
                assert!((found / expected - 1.0).abs() < 1e-12, "{braking:e} {damping:e}: {found:e} {expected:e}");
                assert!(rigid > 1e-6 * expected, "{rigid:e} {expected:e}");
            }
        }
        let undisturbed = precessing(strength);
        for t in [1e3, -1e3] {
            assert_eq!(undisturbed.truncation(t), undisturbed.motion.truncation(t) / turns);
        }
        assert!(undisturbed.truncation(f64::INFINITY) > 0.0);
        // The error estimate near a time is that of the clock's motion.
        let near = Near { clock: &undisturbed, t: [1e3, 1e-3] };
        assert_eq!(near.error_estimate(5.0), undisturbed.motion.error_estimate(1005.0));
    }

    /// The rates are compared with their signs, in averaged motion and on the torus, about either pole of any axis.
    #[test]
    fn rates_of_both_precessions_are_those_of_any_motion() {
        let base = precessing(5e-4).motion.problem;
        let turns = [Vector3::zeros(), Vector3::y() * 2.0, Vector3::x() * PI, Vector3::new(0.3, 1.9, -0.8)];
        for (turn, sign) in turns.iter().flat_map(|turn| [(turn, 1.0), (turn, -1.0)]) {
            let turn = *Rotation3::new(*turn).matrix();
            let problem =
                Problem::new(*base.spheroid(), base.coefficients() * sign, *base.initial()).unwrap().rotated(&turn);
            let rates = |motion: PhasedMotion| {
                let clock = PulsarClock::new(motion, &Beam::new(1.1, 0.4, 0.3), &Observer::at(1.2, -0.5)).unwrap();
                clock.precession_rates().unwrap()
            };
            let averaged = rates(PhasedMotion::averaged(&problem).unwrap());
            let exact = rates(PhasedMotion::torus(&problem, 1e3).unwrap());
            for (averaged, exact) in averaged.into_iter().zip(exact) {
                assert!((averaged / exact - 1.0).abs() < 1e-5, "{sign}: {averaged:e} {exact:e}");
            }
        }
    }

    /// `L` circles Z: `cos i = L.o / |L|` changes at the rate `l' (Z x L).o / |L|`.
    #[test]
    fn the_inclination_of_a_timing_model_changes_as_the_momentum_precesses() {
        let clock = precessing(1e-9);
        let [_, rate] = clock.precession_rates().unwrap();
        let (l, o) = (clock.motion.problem.initial().momentum.normalize(), clock.observer.direction);
        let inclination = l.dot(&o).acos();
        let expected = -rate * Vector3::z().cross(&l).dot(&o) / inclination.sin();
        let model = clock.timing_model().unwrap();
        assert!((model.value(Inclination) - inclination).abs() < 1e-14);
        // A difference over 0.01 rad, for momenta whose nutation is of the size of the strength.
        let found = model.value(InclinationRate);
        assert!((found / expected - 1.0).abs() < 1e-5 && expected.abs() > 1e-10, "{found:e} {expected:e}");
        assert_eq!(precessing(0.0).timing_model().unwrap().value(InclinationRate), 0.0);
    }

    /// Parts that cancel add up to one time.
    #[test]
    fn a_time_may_be_any_sum() {
        let clock = wobbling(0.3);
        let wanted = clock.pulse_near([3.0, 0.0]).unwrap();
        assert_eq!(clock.pulse_near([1e20, -1e20]).unwrap().is_some(), clock.pulse_near([0.0, 0.0]).unwrap().is_some());
        assert_eq!(clock.pulse_near([3.0, 0.0]).unwrap(), wanted);
        assert_eq!(clock.pulse_near([4_503_599_627_370_499.0, -4_503_599_627_370_496.0]).unwrap(), wanted);
    }

    #[test]
    fn the_nearest_pulse_holds_the_time_or_ends_nearest_to_it() {
        let pulse = |start: f64, end: f64| Pulse { start, end, cut_at_start: false, cut_at_end: false };
        let of = |pulses: &[(f64, f64)]| PulseTrain {
            pulses: pulses.iter().map(|(start, end)| pulse(*start, *end)).collect(),
            grazings: Vec::new(),
        };
        // The edges count, not the midpoints: the third pulse is long.
        let train = of(&[(-5.0, -4.0), (1.0, 1.5), (3.0, 9.0)]);
        for (time, start) in [
            (-9.0, -5.0),
            (-4.5, -5.0),
            (-2.0, -5.0),
            (-1.0, 1.0),
            (1.2, 1.0),
            (2.1, 1.0),
            (2.4, 3.0),
            (8.9, 3.0),
            (20.0, 3.0),
        ] {
            assert_eq!(nearest(&train, time).map(|pulse| pulse.start), Some(start), "{time}");
        }
        assert_eq!(nearest(&of(&[]), 0.0), None);
    }
}
