//! Writes the JavaScript glue of WebAssembly modules: `teeter-glue FOLDER MODULE...`.

use std::process::ExitCode;

use wasm_bindgen_cli_support::Bindgen;

fn main() -> ExitCode {
    let mut args = std::env::args_os().skip(1);
    let Some(folder) = args.next() else {
        eprintln!("glue: expected a folder and modules");
        return ExitCode::from(2);
    };
    for module in args {
        let mut bindgen = Bindgen::new();
        bindgen.input_path(&module).typescript(true).omit_default_module_path(false);
        bindgen.remove_name_section(true).remove_producers_section(true);
        if let Err(error) = bindgen.web(true).and_then(|bindgen| bindgen.generate(&folder)) {
            eprintln!("glue: {}: {error:#}", module.display());
            return ExitCode::FAILURE;
        }
    }
    ExitCode::SUCCESS
}
