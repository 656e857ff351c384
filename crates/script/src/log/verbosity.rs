//! Levels of log lines (`sim.verbosity_*`).

pub const ERRORS: i64 = 200;
pub const WARNINGS: i64 = 300;
pub const LOAD_INFOS: i64 = 400;
pub const SCRIPT_ERRORS: i64 = 420;
pub const SCRIPT_WARNINGS: i64 = 430;
pub const SCRIPT_INFOS: i64 = 450;
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

/// Bits scripts may add to a level.
pub const UNDECORATED: i64 = 0x0_f000;
pub const ONLY_TERMINAL: i64 = 0x1_0000;
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
    NAMES.iter().find(|(known, _)| *known == name).map(|(_, level)| *level)
}
