//! The rules: layers, owners of dependencies, rooms within layers.

/// The layers from the inside out; a module may import from its own row's modules it belongs to, and from rows above it.
pub const LAYERS: &[&[&str]] = &[
    &["scene"],
    &["permissions", "ui", "wire"],
    &["dynamics", "format", "ik", "io", "perception"],
    &["script"],
    &["api"],
    &["modules"],
    &["simulator"],
    &["view"],
    &["docs", "testing"],
    &["cli"],
];

/// Who may name what comes from outside of a package: a line for each dependency, several where several folders need it.
pub const OWNERS: &[(&str, &str)] = &[
    ("ab_glyph", "crates/imaging"),
    ("api_macro", "src/api"),
    ("api_macro", "src/modules"),
    ("articulation", "src/dynamics"),
    ("arrayvec", "src/script/property"),
    ("base64", "src/api/data"),
    ("base64", "src/format"),
    ("base64", "src/testing/report"),
    ("base64", "src/ui/json.rs"),
    ("base64", "src/view/recording"),
    ("base64", "src/wire/mime"),
    ("bitflags", "src/scene"),
    ("bytemuck", "crates/rendering"),
    ("ciborium_io", "src/wire"),
    ("ciborium_ll", "src/wire"),
    ("clap", "src/cli"),
    ("clap_complete", "src/cli"),
    ("crc32fast", "src/view/mcap"),
    ("crc32fast", "src/view/recording"),
    ("csv", "src/testing/batch/store.rs"),
    ("ctrlc", "src/cli"),
    ("dejavu", "crates/imaging"),
    ("dejavu", "src/format/plot.rs"),
    ("directories", "src/script/files/app_storage"),
    ("dns_lookup", "src/io/socket"),
    ("flate2", "src/view"),
    ("fs4", "src/api/files"),
    ("fs4", "src/format/scene_file/write.rs"),
    ("fs4", "src/script"),
    ("futures", "src/io"),
    ("geometry", "crates/articulation"),
    ("geometry", "crates/kinematics"),
    ("geometry", "crates/proximity"),
    ("geometry", "crates/rendering"),
    ("geometry", "src/api"),
    ("geometry", "src/dynamics"),
    ("geometry", "src/format"),
    ("geometry", "src/modules"),
    ("geometry", "src/perception"),
    ("geometry", "src/scene"),
    ("geometry", "src/script/property"),
    ("geometry", "src/view"),
    ("gif", "src/format/video"),
    ("httparse", "src/io/ws"),
    ("image", "src/format/picture.rs"),
    ("image_webp", "src/format/video"),
    ("imaging", "src/modules"),
    ("indicatif", "src/cli"),
    ("kinematics", "src/ik"),
    ("kinematics", "src/modules"),
    ("libc", "src/io/signals.rs"),
    ("libm", "src/modules/sim_eigen"),
    ("libm", "src/perception"),
    ("libm", "crates/kinematics"),
    ("libm", "crates/planning"),
    ("libm", "crates/rendering"),
    ("memchr", "src/format/xml"),
    ("memchr", "src/io/socket"),
    ("memchr", "src/wire/mime"),
    ("mlua", "src/lib.rs"),
    ("mlua", "src/script/lua"),
    ("mlua", "src/script/lua_runtime"),
    ("mlua", "src/simulator/builder.rs"),
    ("motion", "src/api"),
    ("motion", "src/dynamics"),
    ("motion", "src/script/step"),
    ("mp4", "src/format/video"),
    ("nalgebra", "crates"),
    ("nalgebra", "src"),
    ("notify", "src/cli/test/watch.rs"),
    ("openh264", "src/format/video"),
    ("parry3d", "crates/geometry"),
    ("parry3d", "src/scene/voxels"),
    ("plotters", "src/format/plot.rs"),
    ("plotters", "src/testing/golden/plot.rs"),
    ("proc_macro2", "crates/api-macro"),
    ("proximity", "src/modules"),
    ("proximity", "src/perception"),
    ("quick_xml", "src/format/xml"),
    ("quick_xml", "src/testing/report/junit.rs"),
    ("quick_xml", "src/ui/xml.rs"),
    ("quote", "crates/api-macro"),
    ("rand_mt", "src/perception"),
    ("rand_mt", "src/script/lifecycle"),
    ("rapier3d", "src/dynamics"),
    ("rendering", "src/perception"),
    ("ring", "src/io/socket/tls.rs"),
    ("ring", "src/view"),
    ("rsruckig", "crates/motion"),
    ("rustix", "src/io"),
    ("rustls", "src/io/socket/tls.rs"),
    ("rustls_native_certs", "src/io/socket/tls.rs"),
    ("ruzstd", "src/view/mcap"),
    ("ruzstd", "src/view/recording"),
    ("serde_json", "src/cli"),
    ("serde_json", "src/format/ttt"),
    ("serde_json", "src/script/property"),
    ("serde_json", "src/simulator/ui.rs"),
    ("serde_json", "src/testing"),
    ("serde_json", "src/ui"),
    ("serde_json", "src/view"),
    ("serialport", "src/io/serial.rs"),
    ("socket2", "src/io/socket"),
    ("strsim", "src/cli/api.rs"),
    ("strsim", "src/script/log"),
    ("syn", "crates/api-macro"),
    ("tempfile", "src/cli/test"),
    ("tempfile", "src/format"),
    ("tempfile", "src/modules/sim_remote_api"),
    ("tempfile", "src/permissions/tests.rs"),
    ("tempfile", "src/script/files/app_storage"),
    ("tempfile", "src/testing"),
    ("thiserror", "crates"),
    ("thiserror", "src"),
    ("tokio", "src/io"),
    ("tokio_tungstenite", "src/io/ws"),
    ("wide", "crates/rendering"),
    ("zmq_sys", "src/io/zmq"),
];

/// The rooms of a layer, and which of the others each may use. What stands at the root of the layer, such as `Scene`, is for all.
pub type Rooms = &'static [(&'static str, &'static [&'static str])];

/// The layers that consist of rooms.
pub const ROOMS: &[(&str, Rooms)] =
    &[("scene", SCENE), ("dynamics", DYNAMICS), ("perception", PERCEPTION), ("format", FORMAT), ("script", SCRIPT)];

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
    ("simulation", &["appearance", "joint", "parameters", "pose", "shape"]),
    ("object", &["appearance", "graph", "joint", "path_object", "pose", "sensor", "shape", "simulation", "voxels"]),
    ("tree", &["appearance", "drawing", "graph", "joint", "object", "pose", "sensor", "shape", "simulation", "voxels"]),
    ("parameters", &["appearance", "joint", "object", "sensor", "shape"]),
    ("store", &["appearance", "drawing", "joint", "object", "pose", "shape", "tree"]),
];

const DYNAMICS: Rooms = &[
    ("convert", &[]),
    ("frozen", &[]),
    ("motors", &[]),
    ("world", &[]),
    ("plan", &["frozen"]),
    ("colliders", &["convert", "plan"]),
    ("bodies", &["colliders", "convert", "plan", "world"]),
    ("contacts", &["bodies", "convert", "world"]),
    ("contact_log", &["bodies", "convert", "world"]),
    ("load", &["convert", "plan", "world"]),
    ("links", &["bodies", "convert", "load", "motors", "plan", "world"]),
    ("mechanisms", &["bodies", "contacts", "convert", "links", "plan", "world"]),
    ("report", &["bodies", "convert", "links", "load", "plan", "world"]),
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
    ("ttt", &[]),
    ("xml", &["picture", "ttt"]),
    ("scene_file", &["ttt", "xml"]),
    ("plot", &[]),
    ("graph_file", &["plot"]),
    ("video", &["picture", "scene_file"]),
    ("scene_folder", &["scene_file", "ttt"]),
    ("scene_outline", &["scene_file", "ttt"]),
    ("script_file", &[]),
    ("scene_input", &["scene_file", "scene_folder", "script_file", "ttt"]),
];

/// `sim` is the simulator that consists of all, `error` and `log` are for all. The host speaks to `runtime`; the languages are behind it.
const SCRIPT: Rooms = &[
    ("error", &[]),
    ("log", &[]),
    ("runtime", &["calls", "coverage", "error", "lifecycle", "sim"]),
    // A state carries the environment of its script.
    ("lua", &["lifecycle", "runtime"]),
    ("lua_runtime", &["binding", "calls", "coverage", "lifecycle", "log", "lua", "runtime", "sim"]),
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
    ("calls", &["binding", "error", "lifecycle", "log", "runtime", "sim"]),
    ("event_loop", &[]),
    ("coverage", &["error", "lifecycle", "log", "runtime", "sim"]),
    ("events", &["calls", "error", "lifecycle", "log", "property", "sim", "step"]),
    ("files", &["calls", "error", "lifecycle", "log", "sim", "step"]),
    ("lifecycle", &["binding", "calls", "coverage", "error", "events", "log", "runtime", "sim"]),
    ("property", &["binding", "error", "events", "files", "lifecycle", "log", "person", "present", "sim", "video"]),
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
pub const LUA_ROOMS: &[&str] = &["binding", "lua", "lua_runtime"];

/// What belongs to Lua: names that code in the other rooms must not use.
pub const LUA_NAMES: &[&str] =
    &["mlua", "lua", "lua_runtime", "Stack", "LuaType", "LuaError", "LuaLanguage", "LuaInterpreter", "UserModule"];

/// Where functions for scripts stand. What they may touch is in their signature: `&Cx` reads, `&mut Cx` changes something or calls scripts.
pub const FUNCTIONS_FOR_SCRIPTS: &[&str] = &["src/api", "src/modules"];

/// The edges to libraries written in C.
pub const UNSAFE: &[&str] = &["src/script/lua", "src/io/signals.rs", "src/io/zmq/libzmq.rs"];

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
pub const NO_PERMISSION_NEEDED: &[(&str, &str)] =
    &[("src/script/coverage/text.rs", "what is read shows in the report for the user only, as line numbers")];
