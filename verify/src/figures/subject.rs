//! A motion as figures need it, and the paper's four examples.

use nalgebra::{Matrix3, Matrix4, Vector4};
use num_dual::Dual64;
use twofold::dynamics::euler_angle_equations::AxisAngles;
use twofold::dynamics::{BodyState, RigidSpheroid};
use twofold::euler_angles::{EulerAngles, EulerRates};
use twofold::lorentz_violation::PrincipalCoefficients;
use twofold::observables::Observer;
use twofold::observables::pulsar::Beam;
use twofold::propagation::{ContinuousAngles, Motion, TaylorMotion, propagate};
use twofold::scalar::Real;
use twofold::solutions::perturbation::{Constants, Kind, Perturbation};

use crate::paper_examples::{COEFFICIENTS, PaperExample, SPIN, paper_examples, spheroid};
use crate::scene_file::Scene;

/// Truncation error of the motions, far below what a picture shows; the data of the figures have all their digits.
const ACCURACY: f64 = 1e-14;

/// Where the observer is and where the beam points; rad.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineOfSight {
    /// Colatitude `theta_o` of the observer.
    pub theta_o: f64,
    /// Azimuth `phi_o` of the observer.
    pub phi_o: f64,
    /// Angle `chi` between the beam and the symmetry axis.
    pub chi: f64,
    /// Azimuth `delta` of the beam in the body.
    pub delta: f64,
    /// Semi-open angle `rho` of the beam.
    pub rho: f64,
}

impl LineOfSight {
    /// Those of the paper's figures.
    pub const PAPER: Self = Self { theta_o: 0.8, phi_o: 0.0, chi: 0.5, delta: 0.0, rho: 0.6 };

    /// The observer.
    pub(super) fn observer(&self) -> Observer<f64> {
        Observer::at(self.theta_o, self.phi_o)
    }

    /// The beam.
    pub(super) fn beam(&self) -> Beam<f64> {
        Beam::new(self.chi, self.delta, self.rho)
    }
}

/// What a motion starts from. Units of the paper, `I^xx = C = 1`, time in `t_c` since the start.
#[derive(Debug, Clone)]
pub struct Start {
    /// The star.
    pub spheroid: RigidSpheroid<f64>,
    /// `s^IJ` in the inertial frame of the state.
    pub violation: Matrix3<f64>,
    /// State at the start.
    pub state: BodyState<f64>,
    /// Euler angles of that state.
    pub angles: EulerAngles<f64>,
}

/// How much of a motion the figures show, in `t_c` from the start; none above the span of the motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shown {
    /// Angles and the path of `e_z`.
    pub angles: f64,
    /// The path of `e_x`, which is wound more tightly.
    pub equatorial_axis: f64,
    /// `m.n`.
    pub beam: f64,
    /// Waves.
    pub waves: f64,
    /// Pulse series.
    pub pulses: f64,
}

/// A motion with everything that figures of it need.
#[derive(Debug, Clone)]
pub struct Subject {
    /// Name in headings, `tp-I`.
    pub name: String,
    /// The star and its first state.
    pub start: Start,
    /// Perturbation solutions with the same initial values, each with its name.
    pub(super) solutions: Vec<(&'static str, Perturbation<f64>)>,
    /// Mean inclination `beta_0` by the constants of integration, where the motion is given by them.
    pub(super) mean_inclination: Option<f64>,
    /// Observer and beam.
    pub line_of_sight: LineOfSight,
    /// How much is shown.
    pub shown: Shown,
    /// The motion.
    pub motion: TaylorMotion<f64>,
}

/// Rotation that figures of any motion show at most (rad): some hundred turns, beyond which curves become a blot.
const MOST_ROTATION: f64 = 600.0;

impl Subject {
    /// The motion of `duration` (t_c, forwards or backwards) from a start.
    ///
    /// Long motions are shown from the start for as long as curves can be told apart.
    ///
    /// # Errors
    /// A motion that cannot be computed.
    pub fn new(name: &str, start: Start, duration: f64, line_of_sight: LineOfSight) -> Result<Self, String> {
        let rate = start.state.momentum.norm() / start.spheroid.inertia_xx;
        let at_most = |rotation: f64| duration.abs().min(rotation / rate.max(1e-12)).copysign(duration);
        let all = at_most(MOST_ROTATION);
        let shown = Shown {
            angles: at_most(0.4 * MOST_ROTATION),
            equatorial_axis: at_most(0.1 * MOST_ROTATION),
            beam: at_most(0.5 * MOST_ROTATION),
            waves: at_most(0.25 * MOST_ROTATION),
            pulses: all,
        };
        Self::showing(name, start, all, line_of_sight, shown)
    }

    /// The motion of a scene, with the paper's observer and beam where the scene names none.
    ///
    /// # Errors
    /// A motion that cannot be computed.
    pub fn of_scene(name: &str, scene: &Scene) -> Result<Self, String> {
        let start = Start {
            spheroid: scene.spheroid,
            violation: scene.violation,
            state: scene.initial,
            angles: scene.initial_angles,
        };
        let duration = (scene.times.last() - scene.times.start()) / scene.units.time;
        Self::new(name, start, duration, LineOfSight::PAPER)
    }

    fn showing(
        name: &str,
        start: Start,
        duration: f64,
        line_of_sight: LineOfSight,
        shown: Shown,
    ) -> Result<Self, String> {
        let motion = propagate(&start.spheroid, &start.violation, &start.state, (0.0, duration), ACCURACY)
            .map_err(|error| format!("{name}: {error}"))?;
        let name = name.to_owned();
        Ok(Self { name, start, solutions: Vec::new(), mean_inclination: None, line_of_sight, shown, motion })
    }

    fn example(example: &PaperExample) -> Result<Self, twofold::Error> {
        let (spheroid, first) = (spheroid(), example.initial_values()?);
        let angles = EulerAngles { alpha: first.alpha, beta: first.beta, gamma: 0.0 };
        let rates = EulerRates {
            alpha: first.alpha_rate,
            beta: first.beta_rate,
            gamma: SPIN - first.alpha_rate * first.beta.cos(),
        };
        let state = BodyState::from_angles(&spheroid, &angles, &rates);
        let start = Start { spheroid, violation: COEFFICIENTS.tensor(), state, angles };
        let printed = Perturbation::printed(example.kind, &spheroid, &COEFFICIENTS, SPIN, &example.constants)?;
        let mut solutions = vec![("perturbation, printed", printed)];
        if example.kind == Kind::Twofold {
            if let Some(corrected) = corrected_solution(&first, &example.constants)? {
                solutions.push(("perturbation, corrected", corrected));
            }
        }
        // Single precession goes round once in 90 to 250 t_c, twofold precession in 4.
        let angles = match example.name {
            "sp-I" => 200.0,
            "sp-II" => 500.0,
            _ => 30.0,
        };
        let shown = Shown { angles, equatorial_axis: 40.0, beam: 200.0, waves: 100.0, pulses: 400.0 };
        let motion = propagate(&start.spheroid, &start.violation, &start.state, (0.0, 500.0), ACCURACY)?;
        Ok(Self {
            name: example.name.to_owned(),
            start,
            solutions,
            mean_inclination: Some(example.constants.beta_0),
            line_of_sight: LineOfSight::PAPER,
            shown,
            motion,
        })
    }

    /// State at a time of the motion.
    pub(super) fn state(&self, t: f64) -> Result<BodyState<f64>, String> {
        self.motion.state(t).map_err(|error| format!("{}: {error}", self.name))
    }

    /// Continuous Euler angles at times in order; those on a pole, where there are none, are left out.
    pub(super) fn angles(&self, times: &[f64]) -> Result<Vec<(f64, EulerAngles<f64>)>, String> {
        let mut angles = ContinuousAngles::new(&self.motion, 0.0, &self.start.angles)
            .map_err(|error| format!("{}: {error}", self.name))?;
        Ok(times.iter().filter_map(|&t| Some((t, angles.at(t).ok()?))).collect())
    }

    /// The parameters in words.
    pub(super) fn parameters(&self) -> String {
        let Start { spheroid, violation, angles, state } = &self.start;
        let spin = state.momentum.dot(&state.axis) / spheroid.inertia_zz;
        let rates = state.rates(spheroid).ok();
        let rate = rates
            .map_or(String::new(), |r| format!(", d*α*/d*t* = {:.4}, d*β*/d*t* = {:.4}", tidy(r.alpha), tidy(r.beta)));
        let off_diagonal = [(0, 1), (0, 2), (1, 2)].iter().any(|&place| violation[place] != 0.0);
        let s = |i: usize| tidy(violation[(i, i)]);
        let frame = if off_diagonal { " and other components" } else { "" };
        format!(
            "*I*^{{zz}}/*I*^{{xx}} = {}, Ω^{{z}} = {}, *s*^{{XX}}, *s*^{{YY}}, *s*^{{ZZ}} = {}, {}, {}{frame}; at *t* = 0: *α* = {:.4}, *β* = {:.4}, \
             *γ* = {:.4}{rate}. Angles in rad, time in *t*_{{c}}.",
            tidy(spheroid.inertia_zz / spheroid.inertia_xx),
            tidy(spin),
            s(0),
            s(1),
            s(2),
            angles.alpha,
            angles.beta,
            angles.gamma,
        )
    }
}

/// The corrected solution that has the initial values `first`, by Newton's method from the constants of the printed one;
/// none where that does not lead to it.
fn corrected_solution(
    first: &AxisAngles<f64>,
    printed: &Constants<f64>,
) -> Result<Option<Perturbation<f64>>, twofold::Error> {
    let wanted = Vector4::new(first.alpha, first.beta, first.alpha_rate, first.beta_rate);
    // The phase of no amplitude would have no derivative.
    let mut x = Vector4::new(printed.alpha_0, printed.beta_0, printed.amplitude.max(1e-4), printed.phase);
    for _ in 0..30 {
        let mut jacobian = Matrix4::zeros();
        let mut residual = Vector4::zeros();
        for i in 0..4 {
            let number = |j: usize| Dual64::new(x[j], if i == j { 1.0 } else { 0.0 });
            let q = corrected(number(0), number(1), number(2), number(3))?.at(Dual64::new(0.0, 0.0));
            let q = [q.alpha, q.beta, q.alpha_rate, q.beta_rate];
            jacobian.set_column(i, &Vector4::from(q.map(|number| number.eps)));
            residual = Vector4::from(q.map(|number| number.re)) - wanted;
        }
        let Some(inverse) = jacobian.try_inverse() else { return Ok(None) };
        let step = inverse * residual;
        x -= step * (0.2 / step.norm()).min(1.0);
        if step.norm() < 1e-12 {
            return corrected(x[0], x[1], x[2], x[3]).map(Some);
        }
    }
    Ok(None)
}

fn corrected<S: Real>(alpha_0: S, beta_0: S, amplitude: S, phase: S) -> Result<Perturbation<S>, twofold::Error> {
    let constant = S::from_f64;
    let paper = spheroid();
    let spheroid = RigidSpheroid {
        inertia_xx: constant(paper.inertia_xx),
        inertia_zz: constant(paper.inertia_zz),
        constant_c: constant(paper.constant_c),
    };
    let s = PrincipalCoefficients::new([COEFFICIENTS.xx, COEFFICIENTS.yy, COEFFICIENTS.zz].map(constant));
    let constants = Constants { alpha_0, beta_0, amplitude, phase };
    Perturbation::corrected_twofold(&spheroid, &s, constant(SPIN), &constants)
}

/// A number without the rounding of its last digits, and zero without a sign.
fn tidy(x: f64) -> f64 {
    let rounded = (x * 1e10).round() / 1e10;
    if rounded == 0.0 { 0.0 } else { rounded }
}

/// `count + 1` times from zero to `end`.
pub(super) fn times(end: f64, count: usize) -> Vec<f64> {
    (0..=count).map(|i| end * i as f64 / count as f64).collect()
}

/// The paper's four examples, in its order.
///
/// # Errors
/// None for the four examples.
pub fn examples() -> Result<[Subject; 4], String> {
    let [a, b, c, d] = paper_examples().map(|example| Subject::example(&example).map_err(|error| error.to_string()));
    Ok([a?, b?, c?, d?])
}
