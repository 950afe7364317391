//! Probe.
use twofold_verify::inference::*;
fn main() {
    for seed in std::env::args().skip(1) {
        let s = Simulation::new(seed.parse().unwrap()).unwrap();
        let f = s.fit().unwrap();
        let at = fit(&s.truth, &s.data, &s.unknowns, s.end).unwrap();
        println!("seed {seed} {:?} data {} chi2 {} / {} from truth {} iterations {} cosine {:e} nonlinear {:?} ; {:?}", s.campaign, s.data.len(), f.chi_squared, f.degrees, at.chi_squared, f.iterations, f.cosine, f.nonlinearity(&s.data, s.end), at.nonlinearity(&s.data,s.end));
        for (i,u) in s.unknowns.iter().enumerate() {
            println!("   {:<24} truth {:>12.8} found {:>12.8} from truth {:>12.8} sigma {:.2e} start {:+.2} pull {:+.2} {:+.2}", u.symbol(), u.value(&s.truth), f.values[i], at.values[i], f.sigmas()[i], (u.value(&s.start)-u.value(&s.truth))/f.sigmas()[i], (f.values[i]-u.value(&s.truth))/f.sigmas()[i], (at.values[i]-u.value(&s.truth))/at.sigmas()[i]);
        }
    }
}
