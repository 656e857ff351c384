//! Levels of log lines (`sim.verbosity_*`).

/// `sim.verbosity_errors`: errors of the simulator.
pub const ERRORS: i64 = 200;
/// `sim.verbosity_warnings`: warnings of the simulator.
pub const WARNINGS: i64 = 300;
/// `sim.verbosity_loadinfos`: messages about loading plugins and files.
pub const LOAD_INFOS: i64 = 400;
/// `sim.verbosity_scripterrors`: errors of scripts.
pub const SCRIPT_ERRORS: i64 = 420;
/// `sim.verbosity_scriptwarnings`: warnings of scripts.
pub const SCRIPT_WARNINGS: i64 = 430;
/// `sim.verbosity_scriptinfos`: messages of scripts; the level without options.
pub const SCRIPT_INFOS: i64 = 450;
/// `sim.verbosity_infos`: messages of the simulator.
pub const INFOS: i64 = 500;

/// The levels as the command line names them.
pub const NAMES: [(&str, i64); 12] = [
    ("none", 100),
    ("errors", ERRORS),
    ("warnings", WARNINGS),
    ("loadinfos", LOAD_INFOS),
    ("scripterrors", SCRIPT_ERRORS),
    ("scriptwarnings", SCRIPT_WARNINGS),
    ("scriptinfos", SCRIPT_INFOS),
    ("infos", INFOS),
    ("debug", 600),
    ("trace", 700),
    ("tracelua", 800),
    ("traceall", 900),
];

/// Bits `sim.verbosity_undecorated`, which scripts may add to a level: the line is shown without its author.
pub const UNDECORATED: i64 = 0x0_f000;
/// Bit `sim.verbosity_onlyterminal`: the line is for the terminal, and not for a status bar.
pub const ONLY_TERMINAL: i64 = 0x1_0000;
/// Bit `sim.verbosity_once`: the line is shown the first time only.
pub const ONCE: i64 = 0x2_0000;

/// The level without its flag bits.
pub fn plain(level: i64) -> i64 {
    level & 0xfff
}

/// The word for a level in log lines.
pub fn name(level: i64) -> &'static str {
    match plain(level) {
        ERRORS | SCRIPT_ERRORS => "error",
        WARNINGS | SCRIPT_WARNINGS => "warning",
        LOAD_INFOS => "loadinfo",
        SCRIPT_INFOS | INFOS => "info",
        600 => "debug",
        700 => "trace",
        800 => "tracelua",
        900 => "traceall",
        _ => "unknown",
    }
}

/// The level with that name, as on the command line.
pub fn from_name(name: &str) -> Option<i64> {
    NAMES
        .iter()
        .find(|(known, _)| *known == name)
        .map(|(_, level)| *level)
}
