//! Forces and equations of motion of a rigid body under Lorentz violation. Eqs. (2), (4), (6), (11), (13), (19), (21)-(25), (28),
//! (35), (60)-(68).

pub mod angular_acceleration;
pub mod bulge;
pub mod equations_of_motion;
pub mod euler_angle_equations;
pub mod first_integrals;
#[cfg(test)]
pub(crate) mod fixture;
pub mod inertia;
pub mod kinetic_energy;
pub mod lagrangian;
pub mod point_masses;
pub mod potential;
mod problem;
mod state;
pub mod torque;
pub mod wave_source;

pub use equations_of_motion::BodyState;
pub use inertia::{PrincipalInertia, RigidSpheroid};
pub use problem::Problem;
pub use state::{AxisState, RotationState};
