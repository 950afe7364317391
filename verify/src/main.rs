//! Temporary listing.
fn main() {
    let filter = std::env::args().nth(1).unwrap_or_default();
    for c in twofold_verify::checks::all() {
        if !c.id.contains(&filter) {
            continue;
        }
        let o = c.run();
        println!("{} {} {:?} {} {:.2}s", if o.passed { "ok  " } else { "FAIL" }, c.id, o.measured, c.bound, o.seconds);
    }
}
