//! A scene as a function of its unknowns.

use nalgebra::Matrix3;
use twofold::dynamics::RigidSpheroid;
use twofold::euler_angles::{EulerAngles, EulerRates};
use twofold::observables::Observer;
use twofold::observables::pulsar::Beam;
use twofold::plan::Start;
use twofold::{Error, Scalar};

use super::Unknown;
use crate::columns::strain_of_scene;
use crate::scene_file::Scene;

/// Everything that a signal depends on, in units `I^xx = C = 1` of the scene, time in `t_c`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Model<S> {
    /// `(I^zz - I^xx) / I^xx`.
    pub oblateness: S,
    /// `C`.
    pub constant_c: S,
    /// `s^IJ`, but for its factor.
    pub s: Matrix3<S>,
    /// Factor of `s^IJ`.
    pub s_scale: S,
    /// Euler angles at the start.
    pub angles: EulerAngles<S>,
    /// Rate of `alpha` there.
    pub alpha_rate: S,
    /// Rate of `beta` there.
    pub beta_rate: S,
    /// `Omega^z`; the rate of `gamma` follows from it.
    pub spin: S,
    /// Magnetic axis, Eq. (45).
    pub chi: S,
    /// Its azimuth.
    pub delta: S,
    /// Semi-open angle of the beam.
    pub rho: S,
    /// Observer, Eq. (46).
    pub theta_o: S,
    /// Its azimuth.
    pub phi_o: S,
    /// Factor of the strain.
    pub strain_scale: S,
    /// Strain of `h = 1` at `r = 1`, not an unknown.
    pub strain_unit: f64,
}

impl Model<f64> {
    /// The model that a scene is. A beam or an observer that the scene lacks are taken as any: nothing that needs them can be
    /// observed (see [`missing_section`](super::Observable::missing_section)).
    ///
    /// # Errors
    /// A scene that starts on a pole or within 1e-6 rad of it, where its angles are no parameters.
    pub fn of_scene(scene: &Scene) -> Result<Self, Error> {
        let sine = scene.initial_angles.beta.sin();
        Error::unless(sine > 1e-6, "sin(beta) at the start", sine, "above 1e-6: on a pole angles are no parameters")?;
        let rates = scene.initial.rates(&scene.spheroid)?;
        let angles = scene.initial_angles;
        let (chi, delta, rho) = scene.pulsar.map_or((0.5, 0.0, 0.5), |pulsar| (pulsar.chi, pulsar.delta, pulsar.rho));
        let (theta_o, phi_o) = scene.observer.map_or((0.5, 0.0), |viewer| (viewer.theta_o, viewer.phi_o));
        let distance = scene.observer.and_then(|viewer| viewer.distance);
        Ok(Self {
            oblateness: scene.spheroid.oblateness(),
            constant_c: scene.spheroid.constant_c,
            s: scene.violation,
            s_scale: 1.0,
            angles,
            alpha_rate: rates.alpha,
            beta_rate: rates.beta,
            spin: rates.gamma + rates.alpha * angles.beta.cos(),
            chi,
            delta,
            rho,
            theta_o,
            phi_o,
            strain_scale: 1.0,
            strain_unit: distance.map_or(1.0, |distance| strain_of_scene(scene, distance)),
        })
    }

    /// The same model with zero derivatives.
    pub fn lifted<S: Scalar>(&self) -> Model<S> {
        let of = S::from_f64;
        let EulerAngles { alpha, beta, gamma } = self.angles;
        Model {
            oblateness: of(self.oblateness),
            constant_c: of(self.constant_c),
            s: self.s.map(of),
            s_scale: of(self.s_scale),
            angles: EulerAngles { alpha: of(alpha), beta: of(beta), gamma: of(gamma) },
            alpha_rate: of(self.alpha_rate),
            beta_rate: of(self.beta_rate),
            spin: of(self.spin),
            chi: of(self.chi),
            delta: of(self.delta),
            rho: of(self.rho),
            theta_o: of(self.theta_o),
            phi_o: of(self.phi_o),
            strain_scale: of(self.strain_scale),
            strain_unit: self.strain_unit,
        }
    }

    /// The model with unknowns moved by some changes.
    pub fn moved(&self, unknowns: &[Unknown], changes: &[f64]) -> Self {
        let mut moved = *self;
        unknowns.iter().zip(changes).for_each(|(unknown, change)| unknown.add(&mut moved, *change));
        moved
    }

    /// The values of some unknowns.
    pub fn values(&self, unknowns: &[Unknown]) -> Vec<f64> {
        unknowns.iter().map(|unknown| unknown.value(self)).collect()
    }
}

impl<S: Scalar> Model<S> {
    /// `s^IJ`.
    pub fn violation(&self) -> Matrix3<S> {
        self.s * self.s_scale
    }

    /// Body, tensor and initial values.
    pub fn start(&self) -> Start<S> {
        let one = S::one();
        let (_, cos) = self.angles.beta.sin_cos();
        Start {
            spheroid: RigidSpheroid { inertia_xx: one, inertia_zz: one + self.oblateness, constant_c: self.constant_c },
            violation: self.violation(),
            angles: self.angles,
            rates: EulerRates {
                alpha: self.alpha_rate,
                beta: self.beta_rate,
                gamma: self.spin - self.alpha_rate * cos,
            },
        }
    }

    /// The beam.
    pub fn beam(&self) -> Beam<S> {
        Beam::new(self.chi, self.delta, self.rho)
    }

    /// The observer.
    pub fn observer(&self) -> Observer<S> {
        Observer::at(self.theta_o, self.phi_o)
    }
}
