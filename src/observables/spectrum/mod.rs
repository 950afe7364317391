//! Spectra of what is observed of a motion: amplitudes by the fast Fourier transform, lists of lines, and which combination of
//! the motion's fundamental frequencies each line is.

mod amplitude;
mod identification;
mod joint_fit;
mod lines;
mod residual_spectrum;
mod series;
mod window;

pub use amplitude::{AmplitudeSpectrum, amplitude_spectrum};
pub use identification::{Combination, FrequencyBasis, Generator, Identification};
pub use lines::{LineList, SpectralLine, spectral_lines};
pub use series::{LEAST_LENGTH, Series};
pub use window::Window;
