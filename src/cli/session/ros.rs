//! `--ros-...`: how scripts take part in networks of ROS.

use std::borrow::Cow;
use std::net::Ipv4Addr;
use std::path::{Path, PathBuf};

use super::setup::seconds;
use format::robot_file::OF_GAZEBO;
use simulator::RosOptions;

/// Options of ROS
#[derive(Debug, Clone, Default, clap::Args)]
pub(in crate::cli) struct RosArgs {
    /// Let ROS use the network, optionally the one of this machine's ADDRESS; otherwise nothing leaves this machine
    #[arg(long, value_name = "ADDRESS", num_args = 0..=1, require_equals = true, default_missing_value = "0.0.0.0")]
    ros_network: Option<Ipv4Addr>,
    /// Folder with interfaces of ROS (.msg, .srv, .action), a package or a prefix of packages; may be repeated
    #[arg(long, value_name = "DIR")]
    ros_interfaces: Vec<PathBuf>,
    /// Without a master of ROS 1, functions of simROS raise an error; otherwise they do nothing, with one warning
    #[arg(long)]
    ros_needs_master: bool,
    /// Publish the time of the simulation, the poses of all objects and the joints by ROS 2 (/clock, /tf, /joint_states)
    #[arg(long)]
    ros2_bridge: bool,
    /// Offer ROS 2's standard simulation interfaces (simulation_interfaces 2.1.0: states, steps, entities, worlds), publish what --ros2-bridge does, and give robots the topics of their sensors and controllers
    #[arg(long)]
    ros2: bool,
    /// TOML file with sensors and controllers of the robot, for --ros2 [default: NAME.ros2.toml beside the scene]
    #[arg(long, value_name = "FILE", requires = "ros2")]
    ros2_robot: Option<PathBuf>,
    /// Topic by which a node of ROS 2 answers each step, or a node with all its topics: a step is over when all have answered, so that a run is the same each time; may be repeated
    #[arg(long, value_name = "TOPIC_OR_NODE", value_parser = topic)]
    ros2_lockstep: Vec<String>,
    /// Wait so long for an answer by --ros2-lockstep, seconds of the wall clock; then the simulation is stopped
    #[arg(long, value_name = "SECONDS", default_value = "5", value_parser = seconds)]
    ros2_lockstep_timeout: f64,
    /// Prefixes of installed packages with interfaces of ROS 2
    #[arg(long, hide = true, env = "AMENT_PREFIX_PATH", value_delimiter = ':')]
    ament_prefix_path: Vec<PathBuf>,
    /// Folders with packages of ROS 1
    #[arg(long, hide = true, env = "ROS_PACKAGE_PATH", value_delimiter = ':')]
    ros_package_path: Vec<PathBuf>,
    /// Address of ROS 1's master
    #[arg(long, hide = true, env = "ROS_MASTER_URI", default_value = "")]
    ros_master_uri: String,
    /// Domain of ROS 2
    #[arg(long, hide = true, env = "ROS_DOMAIN_ID", default_value = "")]
    ros_domain_id: String,
    /// Which nodes of ROS 2 are looked for
    #[arg(
        long,
        hide = true,
        env = "ROS_AUTOMATIC_DISCOVERY_RANGE",
        default_value = ""
    )]
    ros_automatic_discovery_range: String,
    /// Machines with nodes of ROS 2 that multicast does not reach
    #[arg(long, hide = true, env = "ROS_STATIC_PEERS", default_value = "")]
    ros_static_peers: String,
    /// Namespace of the nodes
    #[arg(long, hide = true, env = "ROS_NAMESPACE", default_value = "")]
    ros_namespace: String,
}

/// A text as Lua has it between quotes.
fn lua_text(text: &str) -> String {
    let bytes = text.bytes().map(|byte| format!("\\{byte:03}"));
    format!("\"{}\"", bytes.collect::<String>())
}

fn topic(name: &str) -> Result<String, String> {
    let is_word = |word: &str| {
        let mut letters = word.chars();
        letters
            .next()
            .is_some_and(|first| first.is_ascii_alphabetic() || first == '_')
            && letters.all(|letter| letter.is_ascii_alphanumeric() || letter == '_')
    };
    let words = name.strip_prefix('/').unwrap_or(name);
    let is_topic = words.split('/').all(is_word);
    is_topic
        .then(|| name.to_owned())
        .ok_or_else(|| "the name of a topic or a node is needed, such as /cmd_vel".to_owned())
}

/// The add-on of `--ros2-bridge`.
const BRIDGE: &[u8] = b"bridge = require 'swanilda.ros2_bridge'
function sysCall_init() bridge.start() end
function sysCall_sensing() bridge.publish() end
";

impl RosArgs {
    /// The add-ons that the options ask for: names and texts. Those that wait come after those that publish.
    pub(in crate::cli) fn add_ons(
        &self,
    ) -> impl Iterator<Item = (&'static str, Cow<'static, [u8]>)> {
        let bridge = (self.ros2_bridge && !self.ros2).then_some(("ros2Bridge", BRIDGE.into()));
        let interfaces = self.ros2.then(|| self.interfaces());
        let lockstep = (!self.ros2_lockstep.is_empty()).then(|| self.lockstep());
        bridge.into_iter().chain(interfaces).chain(lockstep)
    }

    /// The add-on of `--ros2` that offers the standard simulation interfaces, and topics of robots.
    fn interfaces(&self) -> (&'static str, Cow<'static, [u8]>) {
        let settings = self.ros2_robot.as_deref();
        let settings = settings.map_or("nil".to_owned(), |path| lua_text(&path.to_string_lossy()));
        let code = format!(
            "interfaces = require 'remote.ros2'
function sysCall_init() interfaces.start({settings}) end
sysCall_nonSimulation, sysCall_suspended = interfaces.wait, interfaces.wait
function sysCall_beforeSimulation() interfaces.beforeStart() end
function sysCall_beforeMainScript() return {{doNotRunMainScript = interfaces.beforeStep()}} end
function sysCall_actuation() interfaces.actuate() end
function sysCall_sensing() interfaces.afterStep() end
function sysCall_afterSimulation() interfaces.afterEnd() end
"
        );
        ("ros2Interfaces", code.into_bytes().into())
    }

    /// Whether what is said of a file is about something that `--ros2` does.
    pub(in crate::cli) fn answers(&self, message: &str) -> bool {
        self.ros2 && message.ends_with(OF_GAZEBO)
    }

    fn lockstep(&self) -> (&'static str, Cow<'static, [u8]>) {
        let topics: Vec<_> = self
            .ros2_lockstep
            .iter()
            .map(|topic| format!("{topic:?}"))
            .collect();
        let (topics, timeout) = (topics.join(", "), self.ros2_lockstep_timeout);
        let code = format!(
            "lockstep, topics, timeout = require 'remote.ros2.lockstep', {{{topics}}}, {timeout:?}
function sysCall_init() lockstep.begin() end
function sysCall_beforeSimulation() lockstep.beforeStart() end
function sysCall_actuation() lockstep.beforeStep(topics, timeout) end
function sysCall_sensing() lockstep.afterStep(topics, timeout) end
"
        );
        ("ros2Lockstep", code.into_bytes().into())
    }

    /// For a scene in this folder, beside which interfaces are searched too.
    pub(in crate::cli) fn options(&self, folder: Option<&Path>) -> RosOptions {
        let beside = folder.map(Path::to_path_buf);
        let folders = self
            .ros_interfaces
            .iter()
            .cloned()
            .chain(beside)
            .chain(self.ament_prefix_path.iter().cloned());
        RosOptions {
            network: self.ros_network,
            interfaces: folders
                .filter(|folder| !folder.as_os_str().is_empty())
                .collect(),
            packages: self
                .ros_package_path
                .iter()
                .filter(|folder| !folder.as_os_str().is_empty())
                .cloned()
                .collect(),
            master: self.ros_master_uri.clone(),
            needs_master: self.ros_needs_master,
            domain: self.ros_domain_id.clone(),
            discovery_range: self.ros_automatic_discovery_range.clone(),
            static_peers: self.ros_static_peers.clone(),
            namespace: self.ros_namespace.clone(),
        }
    }
}
