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
    ("workers", &[]),
    ("world", &[]),
    ("plan", &["frozen"]),
    ("colliders", &["convert", "plan"]),
    ("bodies", &["colliders", "convert", "plan", "world"]),
    ("flat_faces", &[]),
    ("contacts", &["bodies", "convert", "flat_faces", "world"]),
    (
        "exact_contacts",
        &["bodies", "contacts", "convert", "world"],
    ),
    (
        "contact_log",
        &["bodies", "convert", "exact_contacts", "world"],
    ),
    ("load", &["convert", "plan", "world"]),
    (
        "links",
        &["bodies", "convert", "load", "motors", "plan", "world"],
    ),
    ("reach", &[]),
    (
        "linked",
        &[
            "bodies",
            "convert",
            "exact_contacts",
            "links",
            "reach",
            "world",
        ],
    ),
    (
        "mechanisms",
        &[
            "bodies",
            "contacts",
            "exact_contacts",
            "linked",
            "links",
            "plan",
            "workers",
            "world",
        ],
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

/// `sim` is the simulator that consists of all, `error` and `log` are for all. The host speaks to `runtime`; the languages are behind it.
const SCRIPT: Rooms = &[
    ("error", &[]),
    ("log", &[]),
    (
        "runtime",
        &["calls", "coverage", "error", "lifecycle", "sim"],
    ),
    // A state carries the environment of its script.
    ("lua", &["lifecycle", "runtime"]),
    (
        "lua_runtime",
        &[
            "binding",
            "calls",
            "coverage",
            "lifecycle",
            "log",
            "lua",
            "runtime",
            "sim",
            "test_bench",
        ],
    ),
    (
        "python_runtime",
        &[
            "binding",
            "calls",
            "coverage",
            "error",
            "lifecycle",
            "log",
            "lua",
            "lua_runtime",
            "runtime",
            "sim",
            "step",
        ],
    ),
    (
        "binding",
        &[
            "calls",
            "coverage",
            "error",
            "events",
            "files",
            "lifecycle",
            "log",
            "lua",
            "lua_runtime",
            "property",
            "runtime",
            "sim",
            "step",
            "test_bench",
        ],
    ),
    (
        "calls",
        &["binding", "error", "lifecycle", "log", "runtime", "sim"],
    ),
    ("event_loop", &[]),
    ("coverage", &["error", "lifecycle", "log", "runtime", "sim"]),
    ("ros_options", &[]),
    (
        "events",
        &[
            "calls",
            "error",
            "lifecycle",
            "log",
            "property",
            "sim",
            "step",
        ],
    ),
    (
        "files",
        &["calls", "error", "lifecycle", "log", "sim", "step"],
    ),
    (
        "lifecycle",
        &[
            "binding", "calls", "coverage", "error", "events", "log", "runtime", "sim",
        ],
    ),
    ("plugins", &["error", "lifecycle", "log", "sim"]),
    (
        "property",
        &[
            "binding",
            "error",
            "events",
            "files",
            "lifecycle",
            "log",
            "person",
            "present",
            "sim",
            "video",
        ],
    ),
    ("person", &["sim"]),
    ("present", &["log", "sim", "step"]),
    (
        "sim",
        &[
            "binding",
            "calls",
            "event_loop",
            "coverage",
            "error",
            "events",
            "files",
            "lifecycle",
            "log",
            "property",
            "ros_options",
            "runtime",
            "step",
            "test_bench",
        ],
    ),
    ("step", &["calls", "error", "lifecycle", "log", "sim"]),
    ("test_bench", &["coverage", "error", "log"]),
    ("video", &["log", "sim", "step"]),
];

/// The rooms of `script` that know Lua; the others only know that scripts have a language.
pub const LUA_ROOMS: &[&str] = &["binding", "lua", "lua_runtime", "python_runtime"];

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

/// What a script may need a permission for, as code writes it.
pub const SYSTEM_CALLS: &[&str] = &[
    "std::fs",
    "File::",
    "OpenOptions",
    "Command::",
    "TcpListener::bind",
    "TcpStream",
    "UdpSocket",
    "SerialPort::open",
    "Program {",
    "WsEndpoint::connect",
    "env::set_current_dir",
];

/// Files that contain such words and ask nobody, with the reason.
pub const NO_PERMISSION_NEEDED: &[(&str, &str)] = &[(
    "crates/script/src/coverage/text.rs",
    "what is read shows in the report for the user only, as line numbers",
)];
