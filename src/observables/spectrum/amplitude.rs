//! Amplitude spectrum of a series by the fast Fourier transform.

use core::f64::consts::TAU;

use realfft::RealFftPlanner;
use realfft::num_complex::Complex;

use super::{Series, Window};
use crate::error::Error;

/// Amplitudes of a series at equally spaced angular frequencies.
#[derive(Debug, Clone, PartialEq)]
pub struct AmplitudeSpectrum {
    /// Distance of two frequencies, `2 pi / T` (rad per unit of time).
    pub spacing: f64,
    /// Amplitudes at `0, spacing, 2 spacing, ...` up to Nyquist's frequency.
    pub amplitudes: Vec<f64>,
}

impl AmplitudeSpectrum {
    /// Angular frequency (rad per unit of time) and amplitude of each point.
    pub fn points(&self) -> impl Iterator<Item = (f64, f64)> {
        self.amplitudes.iter().enumerate().map(|(index, &amplitude)| (self.spacing * index as f64, amplitude))
    }
}

/// Windowed amplitude spectrum: `A_k = c_k |sum_j w_j x_j exp(-2 pi i j k / N)| / N`, weights `w_j` of mean one, `c_k = 2`
/// (one at frequency zero and at Nyquist's).
///
/// `A cos(w t + p)` with `w` on one of the frequencies, away from zero and Nyquist's by the width of the window, has the
/// amplitude `A` there; between two it is lower by up to 36% (`Uniform`), 15% (`Hann`), 6% (`Kaiser`, shape 20). A constant
/// appears at frequency zero with its size. For exact frequencies and amplitudes see [`spectral_lines`](super::spectral_lines).
///
/// # Errors
/// [`Error::Domain`] for fewer than 16 values, a value that is not finite, a step that is not above zero, and a window out of
/// its domain.
pub fn amplitude_spectrum(series: &Series, window: Window) -> Result<AmplitudeSpectrum, Error> {
    series.check()?;
    let count = series.values.len();
    let mut tapered = window.weights(count)?;
    tapered.iter_mut().zip(&series.values).for_each(|(weight, value)| *weight *= value);
    let mut amplitudes: Vec<f64> =
        transform(tapered).iter().map(|coefficient| coefficient.norm() * 2.0 / count as f64).collect();
    amplitudes[0] /= 2.0;
    if count.is_multiple_of(2) {
        *amplitudes.last_mut().expect("a transform is not empty") /= 2.0;
    }
    Ok(AmplitudeSpectrum { spacing: TAU / series.duration(), amplitudes })
}

/// `sum_j x_j exp(-2 pi i j k / N)` for `k` from 0 to `N/2`.
pub(super) fn transform(mut values: Vec<f64>) -> Vec<Complex<f64>> {
    let plan = RealFftPlanner::new().plan_fft_forward(values.len());
    let mut output = plan.make_output_vec();
    plan.process(&mut values, &mut output).expect("both lengths are those of the plan");
    output
}
