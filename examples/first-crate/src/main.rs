//! A motion, the pulses of its beam, a gradient and a fit.

use twofold::inference::{InferenceError, Observable, Signal, data_of, fit};
use twofold::num_dual::Dual64;
use twofold::parameters::{Parameter, Parameters};
use twofold::{Beam, EulerAngles, EulerRates, Motion, Observer, PrincipalCoefficients, RigidSpheroid, pulse_train};

pub fn main() -> Result<(), InferenceError> {
    // A star in units of I^xx = C = 1, the tensor s^IJ, and how it starts.
    let star = RigidSpheroid::in_units_of_tc(1.1);
    let s = PrincipalCoefficients::new([0.02, 0.01, -0.04]).tensor();
    let angles = EulerAngles { alpha: 0.3, beta: 0.7, gamma: 0.0 };
    let rates = EulerRates { alpha: 1.5, beta: 0.1, gamma: -0.1 };
    let truth =
        Parameters { chi: 0.5, rho: 0.6, theta_o: 0.8, ..Parameters::new(star, s, angles, rates).with_fixed_spin() };

    let motion = truth.problem()?.motion((0.0, 100.0), 1e-12)?;
    println!("beta at t = 42: {:.6}", motion.state(42.0)?.angles()?.beta);

    let (beam, observer) = (Beam::new(0.5, 0.0, 0.6), Observer::at(0.8, 0.0));
    let pulses = pulse_train(&motion, &beam, &observer.direction, (0.0, 100.0))?;
    println!("{} pulses, the first with its midpoint at {:.6}", pulses.pulses.len(), pulses.pulses[0].midpoint());

    // The same motion over dual numbers: the derivative of its end by C.
    let mut lifted = truth.lifted::<Dual64>();
    lifted.spheroid.constant_c.eps = 1.0;
    let end = lifted.problem()?.taylor((0.0, 100.0), 1e-12)?.state(Dual64::from(100.0))?;
    println!("d n^Z / dC at t = 100: {:.6}", end.axis.z.eps);

    // Arrival times with errors of 1e-6 t_c, and the spin and s from them.
    let signal = Signal::new(&truth, 60.0)?;
    let data = data_of(&signal, &signal.events()?[1..], &[], &[(Observable::Arrivals, 1e-6)])?;
    let unknowns = [Parameter::Spin, Parameter::SAxial];
    let found = fit(&truth.moved(&unknowns, &[1e-4, -1e-4]), &data, &unknowns, 60.0)?;
    println!("2 s^ZZ - s^XX - s^YY = {:.9} +- {:.1e}", found.fisher.values()[1], found.fisher.sigmas()[1]);
    Ok(())
}
