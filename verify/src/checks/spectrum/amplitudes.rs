//! Amplitude spectra and their windows.

use crate::prelude::*;
use twofold::observables::spectrum::{Window, amplitude_spectrum};

const WINDOWS: [Window; 4] =
    [Window::Uniform, Window::Hann, Window::Kaiser { shape: 10.0 }, Window::Kaiser { shape: 20.0 }];

checks! {
    /// a sinusoid of amplitude A on a frequency of the transform has the amplitude A there, for every window, and a constant its size at frequency
    /// zero
    Property "spectrum-amplitudes" [47, 71]: amplitudes;
    AtMost(4e-8) "largest relative error, even and odd lengths";
    because "what the Kaiser windows leak from the line at the negative frequency and the constant is below 1.8e-8 (shape 20), of the sum with the \
     constant twice that; the others leak nothing to whole bins; shape 10 is left out as it leaks 2e-4";
    /// the squares of a spectrum's amplitudes sum to the mean square of the tapered series (Parseval), for every window
    Property "spectrum-parseval" [47, 71]: parseval;
    AtMost(1e-14) "largest relative difference, random series of 16 to 1,000 values";
    because "rounding of a transform, about 2.2e-16 log2(N) / 2, and of a sum of 1,000 squares";
    /// each window's line has its first zero and its largest sidelobe where the documentation says
    Property "spectrum-windows" [47, 71]: windows;
    AtMost(0.03) "largest relative deviation of the largest sidelobe and of the half width";
    because "two digits are documented; the scan has 100 points a bin";
}

fn amplitudes() -> Result<Measured, String> {
    let step = 0.37;
    let windows = |count| [Window::Uniform, Window::Hann, Window::Kaiser { shape: 20.0 }].map(|window| (count, window));
    worst_of([256, 257].into_iter().flat_map(windows), |&(count, window)| {
        worst_of([(24, 0.7, 0.3), (60, 2.0, -1.2), (100, 1e-3, 3.0)], |&(bin, amplitude, phase)| {
            let wave = |j: usize| amplitude * ((TAU * (bin * j) as f64 / count as f64) + phase).cos();
            let values = (0..count).map(|j| amplitude + wave(j)).collect();
            let spectrum = amplitude_spectrum(&Series { start: -5.0, step, values }, window)?;
            let frequency = TAU * bin as f64 / (count as f64 * step);
            let ratios = [
                spectrum.amplitudes[bin] / amplitude,
                spectrum.amplitudes[0] / amplitude,
                spectrum.spacing * bin as f64 / frequency,
            ];
            Ok(largest(ratios.map(|ratio| (ratio - 1.0).abs())))
        })
    })
}

fn parseval() -> Result<Measured, String> {
    let mut random = Random::with_seed(47);
    let windows = |count| WINDOWS.map(|window| (count, window));
    worst_of([16, 17, 100, 243, 512, 1000].into_iter().flat_map(windows), |&(count, window)| {
        let values: Vec<f64> = (0..count).map(|_| random.within(-1.0, 3.0)).collect();
        let weights = window.weights(count)?;
        let square: f64 = values.iter().zip(&weights).map(|(x, w)| (x * w).powi(2)).sum::<f64>() / count as f64;
        let spectrum = amplitude_spectrum(&Series { start: 0.0, step: 0.1, values }, window)?;
        let whole = |index: usize| index == 0 || 2 * index == count;
        let share = |(index, a): (usize, &f64)| if whole(index) { a * a } else { a * a / 2.0 };
        let sum: f64 = spectrum.amplitudes.iter().enumerate().map(share).sum();
        Ok((sum / square - 1.0).abs())
    })
}

fn windows() -> Result<Measured, String> {
    // The documentation's table: sidelobe, half width times T.
    let documented = [(0.217, TAU), (0.0267, 2.0 * TAU), (2.0e-4, 21.0), (1.79e-8, 40.5)];
    worst_of(WINDOWS.into_iter().zip(documented), |&(window, (sidelobe, width))| {
        let weights = window.weights(128)?;
        let transform = |f: f64| {
            let cosines = weights.iter().enumerate().map(|(j, w)| w * (f * ((j as f64 + 0.5) / 128.0 - 0.5)).cos());
            cosines.sum::<f64>() / 128.0
        };
        let scan: Vec<f64> = (0..1000).map(|i| transform(0.02 * PI * f64::from(i))).collect();
        let zero = scan.iter().position(|&x| x <= 0.0).ok_or("no zero")?;
        let found = largest(scan[zero..].iter().map(|x| x.abs()));
        let first = 0.02 * PI * zero as f64;
        Ok(largest([found / sidelobe, first / width, window.half_width(1.0) / width].map(|ratio| (ratio - 1.0).abs())))
    })
}
