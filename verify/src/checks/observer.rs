//! Direction of the observer and the basis normal to it. Eqs. (46), (70).

use crate::prelude::*;

checks! {
    /// n-hat has its colatitude from Z and its azimuth from X; theta-hat and sin(theta) phi-hat are its derivatives by them; the three are a
    /// right-handed orthonormal basis
    observer_basis: Autodiff "observer-basis" [46, 70];
}

/// The observer of a random point.
pub(super) fn observer<F: Differentiable>(p: &Point<F>) -> Observer<F> {
    Observer::at(p.frame.beta, p.frame.alpha)
}

fn observer_basis<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let (theta, phi) = (p.frame.beta, p.frame.alpha);
    let ((sin_theta, cos_theta), (sin_phi, cos_phi)) = (theta.sin_cos(), phi.sin_cos());
    let Observer { direction, theta_hat, phi_hat } = observer(p);
    let along = |theta, phi| Observer::<F::First>::at(theta, phi).direction.map(F::derivative);
    let by_theta = along(F::first(theta, F::one()), F::fixed(phi));
    let by_phi = along(F::fixed(theta), F::first(phi, F::one()));
    let horizontal = Vector3::new(direction.x, direction.y, F::zero());
    components![
        direction.z - cos_theta,
        // The horizontal part lies along (cos phi, sin phi) and has the length sin theta.
        direction.x * sin_phi - direction.y * cos_phi,
        direction.x * cos_phi + direction.y * sin_phi - sin_theta,
        horizontal.dot(&horizontal) - sin_theta * sin_theta,
        theta_hat.dot(&theta_hat) - F::one(),
        phi_hat.dot(&phi_hat) - F::one(),
        theta_hat.dot(&phi_hat),
        theta_hat - by_theta,
        phi_hat * sin_theta - by_phi,
        theta_hat.cross(&phi_hat) - direction,
    ]
}
