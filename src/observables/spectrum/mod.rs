//! Spectra of time series: amplitudes by the fast Fourier transform, lists of lines, and lines as combinations of the fundamental frequencies
//! of the motion.
//!
//! ```
//! use twofold::observables::spectrum::{
//!     FrequencyBasis, Generator, Series, Window, amplitude_spectrum, spectral_lines,
//! };
//!
//! // Two lines, 0.3 + 1.1 and 1.1.
//! let signal = |t: f64| (1.1 * t).cos() + 0.2 * (1.4 * t + 0.5).cos();
//! let series = Series { start: 0.0, step: 0.5, values: (0..2000).map(|k| signal(0.5 * f64::from(k))).collect() };
//! let spectrum = amplitude_spectrum(&series, Window::Hann)?;
//! assert!(spectrum.amplitudes.iter().all(|amplitude| *amplitude < 1.01));
//! let lines = spectral_lines(&series, 1e-6, 10)?.lines;
//! assert!((lines[0].frequency - 1.1).abs() < 1e-9 && (lines[1].amplitude - 0.2).abs() < 1e-9);
//! let generator = |symbol, frequency| Generator { symbol, frequency, uncertainty: 1e-9 };
//! let basis = FrequencyBasis::new(vec![generator("a", 1.1), generator("b", 0.3)])?;
//! let name = basis.identify(lines[1].frequency, lines[1].uncertainty).to_string();
//! assert!(name.contains('a') && name.contains('b'), "{name}");
//! # Ok::<(), twofold::Error>(())
//! ```

mod amplitude;
mod identification;
mod joint_fit;
mod lines;
mod residual_spectrum;
mod series;

pub use crate::numerics::window::Window;
pub use amplitude::{AmplitudeSpectrum, amplitude_spectrum};
pub use identification::{Combination, FrequencyBasis, Generator, Identification};
pub use lines::{LineList, SpectralLine, spectral_lines};
pub use series::{LEAST_LENGTH, Series};
