//! Draws the picture of the README: `cargo run --release -p twofold-tools --bin readme_picture`.

fn main() -> Result<(), String> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/images/perturbation.svg");
    std::fs::write(path, twofold_command::figures::readme_picture()?).map_err(|error| error.to_string())
}
