//! The C header for plugins: types and constants of CoppeliaSim's plugin interface, and every function that Swanilda has, from the same
//! rows as the functions themselves.

use std::fmt::Write as _;

use script::pairs;

const HEAD: &str = include_str!("head.h");
const END: &str = include_str!("end.h");

/// `include/swanilda_plugin.h`.
pub(super) fn text() -> String {
    let mut out = String::from(HEAD);
    out.push_str("/* The constants of scripts: sim.handle_all is sim_handle_all. */\nenum {\n");
    for (name, value) in pairs(api::SIM.constants) {
        let _ = writeln!(out, "    sim_{name} = {value},");
    }
    out.push_str("};\n\n");
    out.push_str("/* X(result, name, symbol, parameters) for every function. A parameter n... is the number of values of the one before it. */\n");
    out.push_str("#define SWANILDA_FUNCTIONS(X)");
    for row in c_interface::plugin_interface()
        .symbols()
        .filter(|row| !row.is_missing() && !row.is_launch())
    {
        // Without the suffix for double precision, as plugins call it.
        let name = row.symbol.trim_end_matches("_D");
        let _ = write!(
            out,
            " \\\n    X({}, {name}, \"{}\", ({}))",
            row.c_result(),
            row.symbol,
            row.c_params()
        );
    }
    out.push_str("\n\n");
    out.push_str(END);
    out
}
