//! What comes from outside a simulator, or may be asked of the system.

/// Where values from outside get onto the tape of a simulator, with what comes there. Functions that modules mark as `outside` do so in
/// `binding/outside.rs`, whatever they call.
pub const INPUTS: &[(&str, &str)] = &[
    (
        "crates/format/src/robot_file/mesh_files.rs",
        "where packages of ROS are",
    ),
    (
        "crates/modules-messaging/src/sim_remote_api/service.rs",
        "clients of the legacy remote API",
    ),
    (
        "crates/modules-messaging/src/sim_remote_api/services.rs",
        "their commands",
    ),
    (
        "crates/modules-messaging/src/sim_ws/endpoints.rs",
        "events of WebSockets",
    ),
    (
        "crates/modules-messaging/src/sim_ws/log.rs",
        "times of log lines",
    ),
    (
        "crates/modules-messaging/src/sim_ws/mod.rs",
        "whether ports are free",
    ),
    (
        "crates/modules-ros/src/sim_ros/network.rs",
        "messages, parameters and services of ROS 1",
    ),
    (
        "crates/modules-ros/src/sim_ros/node.rs",
        "the time of ROS 1",
    ),
    (
        "crates/modules-ros/src/sim_ros2/endpoint.rs",
        "messages of ROS 2",
    ),
    (
        "crates/modules-ros/src/sim_ros2/lockstep.rs",
        "which nodes of ROS 2 have answered",
    ),
    (
        "crates/modules-ros/src/sim_ros2/node.rs",
        "whether there is a node of ROS 2",
    ),
    (
        "crates/modules-windows/src/sim_qml/engine.rs",
        "answers of interfaces in QML",
    ),
    (
        "crates/modules-windows/src/sim_qml/engines.rs",
        "whether there is Qt, and messages of interfaces in QML",
    ),
    (
        "crates/modules-ros/src/sim_ros2/services.rs",
        "whether its services are there",
    ),
    (
        "crates/modules-ros/src/sim_ros2/times.rs",
        "the time of ROS",
    ),
    ("crates/permissions/src/files.rs", "files"),
    ("crates/permissions/src/lib.rs", "where links lead"),
    ("crates/script/src/app_storage/mod.rs", "persistent data"),
    (
        "crates/script/src/binding/outside.rs",
        "results of functions that call the world outside",
    ),
    (
        "crates/script/src/calls/event_batches.rs",
        "times of events",
    ),
    ("crates/script/src/clock.rs", "the clock"),
    (
        "crates/script/src/lua/permissions/loading.rs",
        "files of modules",
    ),
    (
        "crates/script/src/lua_runtime/taped.rs",
        "Lua's own libraries",
    ),
    ("crates/script/src/options/waiting.rs", "how long is waited"),
    ("crates/script/src/person.rs", "answers to dialogs"),
    (
        "crates/script/src/python_runtime/link.rs",
        "messages of Python's processes",
    ),
    (
        "crates/script/src/python_runtime/mod.rs",
        "whether Python starts",
    ),
    ("crates/simulator/src/servers.rs", "addresses of servers"),
    ("crates/view/src/viewer/mod.rs", "requests of pages"),
    ("src/cli/run/mod.rs", "requests to end the program"),
    ("src/cli/session/live.rs", "requests to end the program"),
    (
        "src/cli/replay/command_loop.rs",
        "requests to end the program",
    ),
    ("src/cli/session/mod.rs", "requests to end the program"),
];

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
