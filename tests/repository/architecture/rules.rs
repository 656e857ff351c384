//! The rules: rooms within crates, and who may do what.

/// The rooms of a crate, and which of the others each may use. What stands at its root, such as `Scene`, is for all.
pub type Rooms = &'static [(&'static str, &'static [&'static str])];

/// The crates that consist of rooms.
pub const ROOMS: &[(&str, Rooms)] = &[
    ("scene", SCENE),
    ("dynamics", DYNAMICS),
    ("perception", PERCEPTION),
    ("format", FORMAT),
    ("script", SCRIPT),
];

const SCENE: Rooms = &[
    ("error", &[]),
    ("values", &[]),
    ("journal", &["values"]),
    ("voxels", &[]),
    ("graph", &[]),
    // Images lie on the meshes of shapes.
    ("appearance", &["shape"]),
    ("sensor", &["appearance"]),
    ("path_object", &["appearance"]),
    ("drawing", &["appearance"]),
    ("shape", &["appearance", "voxels"]),
    ("joint", &["parameters"]),
    ("pose", &["joint"]),
    (
        "simulation",
        &["appearance", "joint", "parameters", "pose", "shape"],
    ),
    (
        "object",
        &[
            "appearance",
            "graph",
            "joint",
            "path_object",
            "pose",
            "sensor",
            "shape",
            "simulation",
            "values",
            "voxels",
        ],
    ),
    (
        "tree",
        &[
            "appearance",
            "drawing",
            "graph",
            "joint",
            "object",
            "pose",
            "sensor",
            "shape",
            "simulation",
            "voxels",
        ],
    ),
    (
        "parameters",
        &["appearance", "joint", "object", "sensor", "shape"],
    ),
    (
        "store",
        &[
            "appearance",
            "drawing",
            "joint",
            "object",
            "pose",
            "shape",
            "tree",
        ],
    ),
];

const DYNAMICS: Rooms = &[
    ("convert", &[]),
    ("frozen", &[]),
    ("motors", &[]),
    ("actuators", &["motors"]),
    ("free_rotation", &[]),
    ("fluid", &[]),
    ("moving_surfaces", &["convert"]),
    ("world", &["free_rotation", "moving_surfaces"]),
    ("plan", &["frozen"]),
    ("bodies", &["convert", "fluid", "plan", "world"]),
    ("flat_faces", &[]),
    (
        "contacts",
        &[
            "bodies",
            "convert",
            "flat_faces",
            "moving_surfaces",
            "plan",
            "world",
        ],
    ),
    ("near", &["bodies", "contacts", "free_rotation", "world"]),
    ("load", &["convert", "plan", "world"]),
    (
        "links",
        &[
            "actuators",
            "bodies",
            "convert",
            "load",
            "motors",
            "plan",
            "world",
        ],
    ),
    (
        "tendons",
        &[
            "actuators",
            "bodies",
            "convert",
            "links",
            "motors",
            "plan",
            "world",
        ],
    ),
    (
        "mechanisms",
        &[
            "bodies",
            "contacts",
            "convert",
            "free_rotation",
            "links",
            "near",
            "plan",
            "tendons",
            "world",
        ],
    ),
    ("contact_log", &["bodies", "convert", "mechanisms", "world"]),
    (
        "soft_bodies",
        &[
            "bodies",
            "contact_log",
            "contacts",
            "convert",
            "near",
            "plan",
            "world",
        ],
    ),
    ("particles", &["bodies", "convert", "world"]),
    ("adhesion", &["bodies", "contacts", "near", "world"]),
    (
        "sub_step",
        &["adhesion", "contacts", "convert", "soft_bodies", "world"],
    ),
    (
        "report",
        &["bodies", "convert", "links", "load", "plan", "world"],
    ),
];

const PERCEPTION: Rooms = &[
    ("vision", &[]),
    ("entity", &[]),
    ("index", &["entity"]),
    ("volume", &[]),
    ("pairs", &["entity", "index"]),
    ("collision", &["entity", "index", "pairs"]),
    ("distance", &["entity", "index", "pairs"]),
    ("detection", &["entity", "index", "volume"]),
    ("items", &["detection", "volume"]),
];

const FORMAT: Rooms = &[
    ("picture", &[]),
    ("gltf_file", &["mesh_file", "scene_file", "ttt"]),
    ("mesh_file", &["picture", "scene_file"]),
    ("ttt", &[]),
    ("xml", &["picture", "ttt"]),
    ("scene_file", &["ttt", "xml"]),
    ("robot_file", &["mesh_file", "scene_file", "ttt"]),
    ("plot", &[]),
    ("graph_file", &["plot"]),
    ("video", &["picture", "scene_file"]),
    ("scene_folder", &["scene_file", "ttt"]),
    ("scene_outline", &["scene_file", "ttt"]),
    ("script_file", &[]),
    (
        "scene_input",
        &[
            "gltf_file",
            "robot_file",
            "scene_file",
            "scene_folder",
            "script_file",
            "ttt",
        ],
    ),
];

/// Three floors and a roof (docs/ARCHITECTURE.md): what knows no simulator, the simulator, what happens to it, and what scripts see of
/// it. Methods of `Sim` count as uses of the room that has them.
const SCRIPT: Rooms = &[
    ("error", &[]),
    ("log", &[]),
    ("wall_clock", &[]),
    ("json", &[]),
    ("function_ref", &[]),
    ("sys_call", &[]),
    ("budget", &[]),
    ("random", &[]),
    ("event_loop", &[]),
    ("ros_options", &[]),
    ("coverage", &[]),
    // What comes from outside, on the tape.
    ("tape", &["error"]),
    ("clock", &["wall_clock"]),
    ("phases", &["wall_clock"]),
    (
        "options",
        &["error", "log", "random", "ros_options", "wall_clock"],
    ),
    ("app_storage", &["log", "wall_clock"]),
    ("event_stream", &["log"]),
    ("test_cases", &["coverage"]),
    ("test_bench", &["coverage", "log", "options", "test_cases"]),
    ("lua", &["budget", "function_ref"]),
    ("binding", &["error", "function_ref", "lua", "tape"]),
    (
        "host",
        &[
            "app_storage",
            "binding",
            "budget",
            "clock",
            "coverage",
            "error",
            "event_loop",
            "event_stream",
            "function_ref",
            "log",
            "options",
            "random",
            "sys_call",
            "test_bench",
        ],
    ),
    ("person", &["host", "tape"]),
    ("present", &["clock", "host", "log", "state_hash"]),
    ("video", &["clock", "host", "log"]),
    (
        "property",
        &["binding", "error", "event_stream", "host", "log", "random"],
    ),
    ("state_hash", &["host", "property"]),
    ("events", &["event_stream", "host", "property", "sys_call"]),
    (
        "lifecycle",
        &[
            "clock", "error", "events", "host", "log", "property", "sys_call",
        ],
    ),
    (
        "calls",
        &[
            "binding",
            "error",
            "event_stream",
            "events",
            "function_ref",
            "host",
            "lifecycle",
            "log",
            "phases",
            "sys_call",
            "wall_clock",
        ],
    ),
    ("plugins", &["calls", "error", "host", "log"]),
    (
        "files",
        &[
            "calls",
            "error",
            "events",
            "host",
            "lifecycle",
            "log",
            "plugins",
            "sys_call",
        ],
    ),
    (
        "step",
        &[
            "binding",
            "calls",
            "clock",
            "error",
            "host",
            "lifecycle",
            "log",
            "phases",
            "plugins",
            "present",
            "state_hash",
            "sys_call",
            "video",
        ],
    ),
    (
        "lua_runtime",
        &[
            "binding",
            "coverage",
            "error",
            "events",
            "function_ref",
            "host",
            "log",
            "lua",
            "sys_call",
            "tape",
            "test_bench",
        ],
    ),
    (
        "cx",
        &[
            "app_storage",
            "binding",
            "calls",
            "clock",
            "coverage",
            "error",
            "event_stream",
            "events",
            "files",
            "function_ref",
            "host",
            "lifecycle",
            "lua",
            "lua_runtime",
            "options",
            "person",
            "plugins",
            "property",
            "state_hash",
            "step",
            "sys_call",
            "test_bench",
        ],
    ),
    (
        "python_runtime",
        &[
            "binding",
            "coverage",
            "error",
            "events",
            "function_ref",
            "host",
            "log",
            "lua",
            "lua_runtime",
            "sys_call",
            "wall_clock",
        ],
    ),
];

/// Crates whose root only has names for other crates: their own code names rooms.
pub const ROOTS_FOR_OTHERS: &[&str] = &["script"];

/// Crates where rooms stand on rooms that stand on them, with the reason.
pub const CIRCLES: &[(&str, &str)] = &[(
    "scene",
    "an object names its kinds, and each kind what all objects have",
)];

/// The type whose methods stand in the rooms of their matter.
pub const SHARED_TYPE: (&str, &str) = ("script", "Sim");

/// The rooms of `script` that know Lua; the others only know that scripts have a language.
pub const LUA_ROOMS: &[&str] = &["binding", "cx", "lua", "lua_runtime", "python_runtime"];

/// What belongs to Lua: names that code in the other rooms must not use.
pub const LUA_NAMES: &[&str] = &[
    "mlua",
    "lua",
    "lua_runtime",
    "Stack",
    "LuaType",
    "LuaError",
    "LuaLanguage",
    "LuaInterpreter",
    "UserModule",
];

/// Crates with functions for scripts, by the begin of their names. What the functions may touch is in their signature: `&Cx` reads,
/// `&mut Cx` changes something or calls scripts.
pub const FUNCTIONS_FOR_SCRIPTS: &[&str] = &["api", "modules"];
