//! The command `twofold`.

fn main() -> std::process::ExitCode {
    twofold_verify::command::main()
}
