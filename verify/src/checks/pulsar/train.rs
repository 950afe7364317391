//! The pulse train: its edges, a closed form and symmetries. Eq. (44).

use super::cases::{edges, upright_star, worst_over_random_cases};
use crate::prelude::*;

checks! {
    /// at every edge of 600 random trains m.n is cos rho
    Property "pulse-train-edges" [44]: margin_at_edges;
    AtMost(2.0) "largest |m.n - cos rho| / (2.2e-16 (4 + t |Omega|))";
    because "some roundings of m.n, and the rounding of t by half an ulp and of Newton's step by one";
    /// the trains of a star that spins about Z are those of Eqs. (51), (56), exact there: pulses, always on (the beam covers the pole) and never on
    Oracle "pulse-train-closed-form" [44, 51, 53, 56]: against_closed_form;
    AtMost(16.0) "largest error of an edge / (2.2e-16 (1 + t) times the edge's sensitivity); infinite for a wrong number";
    because "the phase of a numerical motion of 100 steps is in error by some ten ulp";
    /// the opposite beam with the supplement of rho is on exactly between the pulses, and a part of the span gives the same pulses, cut at its ends
    Property "pulse-train-symmetries" [44]: symmetries;
    AtMost(1e-13) "largest difference of an edge; infinite for a wrong number";
    because "the same roots from other brackets: rounding of t up to 40 t_c, 7e-15, and of m.n over its slope";
}

const SPAN: (f64, f64) = (0.0, 20.0);

fn margin_at_edges() -> Result<Measured, String> {
    worst_over_random_cases(45, 300, (SPAN.1, 1e-14), |case| {
        largest_if_any(edges(&case.train()?).into_iter().map(|t| {
            let scale = f64::EPSILON * (4.0 + t * case.turning(&case.motion.state(t)?));
            Ok(case.margin(t)[0].abs() / scale)
        }))
    })
}

fn against_closed_form() -> Result<Measured, String> {
    let mut kinds = [0; 3];
    let measured = worst_of_draws(53, 400, |random| {
        let [chi, theta_o] = [0; 2].map(|_| random.within(0.01, PI - 0.01));
        let (phi_o, delta, rho) = (random.within(-PI, PI), random.within(-PI, PI), random.within(0.05, 2.5));
        let spin = random.within(0.3, 2.0);
        let motion = upright_star(random.within(0.5, 1.8), spin)?.taylor(SPAN, 1e-15)?;
        let observer = Observer::at(theta_o, phi_o);
        let train = pulse_train(&motion, &Beam::new(chi, delta, rho), &observer.direction, SPAN)?;
        let right = match pulse_width(rho, chi, theta_o) {
            PulseWidth::Pulsed(width) => {
                kinds[0] += 1;
                let mut expected: Vec<f64> = (-4..20)
                    .flat_map(|k| [-width / 2.0, width / 2.0].map(|w| (phi_o - delta + TAU * f64::from(k) + w) / spin))
                    .filter(|t| SPAN.0 < *t && *t < SPAN.1)
                    .collect();
                expected.sort_by(f64::total_cmp);
                let found = edges(&train);
                // m.n changes by sin Theta sin theta_o sin(W/2) per radian.
                let slope = chi.sin() * theta_o.sin() * (width / 2.0).sin().abs();
                let scale = |t: f64| f64::EPSILON * (1.0 + t) * (1.0 + 1.0 / (slope * spin));
                if found.len() == expected.len() {
                    return Ok(largest(found.iter().zip(&expected).map(|(a, b)| (a - b).abs() / scale(*b))));
                }
                false
            }
            PulseWidth::AlwaysOn => {
                kinds[1] += 1;
                let whole = train.pulses.len() == 1 && train.pulses[0].cut_at_start && train.pulses[0].cut_at_end;
                whole && train.pulses[0].duration() == SPAN.1
            }
            PulseWidth::NeverOn => {
                kinds[2] += 1;
                train.pulses.is_empty()
            }
        };
        Ok(if right { 0.0 } else { f64::INFINITY })
    });
    if kinds.contains(&0) { Err(format!("a kind was never met: {kinds:?}")) } else { measured }
}

fn symmetries() -> Result<Measured, String> {
    worst_over_random_cases(47, 100, (SPAN.1, 1e-14), |case| {
        let whole = edges(&case.train()?);
        let supplement = Beam { half_opening: PI - case.beam.half_opening, ..case.beam.opposite() };
        let between = pulse_train(&case.motion, &supplement, &case.observer, SPAN)?;
        let part = pulse_train(&case.motion, &case.beam, &case.observer, (13.7, 4.3))?;
        let within: Vec<f64> = whole.iter().copied().filter(|t| (4.3..=13.7).contains(t)).collect();
        let figure = largest([
            case.difference_of_edges(&whole, &edges(&between)),
            case.difference_of_edges(&within, &edges(&part)),
        ]);
        let cut = part.pulses.iter().all(|p| p.cut_at_start == (p.start == 4.3) && p.cut_at_end == (p.end == 13.7));
        Ok(if cut { figure } else { f64::INFINITY })
    })
}
