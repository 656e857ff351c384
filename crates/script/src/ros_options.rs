//! How scripts take part in networks of ROS.

use std::net::Ipv4Addr;
use std::path::PathBuf;

/// Options of ROS, both generations.
#[derive(Debug, Clone, Default)]
pub struct RosOptions {
    /// The address of this machine in the network to be used, unspecified for the one the system prefers; None: this machine only.
    pub network: Option<Ipv4Addr>,
    /// Folders with further interfaces (`.msg`, `.srv`, `.action`), searched in this order.
    pub interfaces: Vec<PathBuf>,
    /// Folders with packages of ROS 1, searched after the others.
    pub packages: Vec<PathBuf>,
    /// The address of ROS 1's master; empty for that of this machine, `http://localhost:11311`.
    pub master: String,
    /// Without a master of ROS 1, functions raise an error instead of doing nothing.
    pub needs_master: bool,
    /// The domain of ROS 2, as ROS_DOMAIN_ID states it: a number from 0 to 232; empty for 0.
    pub domain: String,
    /// Which nodes of ROS 2 are looked for, as ROS_AUTOMATIC_DISCOVERY_RANGE states it: `SUBNET`, `LOCALHOST`, `OFF`; empty for `SUBNET`. Without
    /// `network` all but `OFF` is this machine.
    pub discovery_range: String,
    /// Machines where nodes of ROS 2 are looked for without multicast, as ROS_STATIC_PEERS states them: addresses or names with `;` between them.
    pub static_peers: String,
    /// Where the names of the node of ROS 2 belong; empty for none.
    pub namespace: String,
}

impl RosOptions {
    /// Where interfaces of ROS 1 are searched.
    pub fn package_folders(&self) -> impl Iterator<Item = &PathBuf> {
        self.interfaces.iter().chain(&self.packages)
    }

    /// The address of ROS 1's master.
    #[must_use]
    pub fn master_uri(&self) -> &str {
        if self.master.is_empty() {
            "http://localhost:11311"
        } else {
            &self.master
        }
    }

    /// Where interfaces are searched.
    pub fn interface_folders(&self) -> impl Iterator<Item = &PathBuf> {
        self.interfaces.iter()
    }
}
