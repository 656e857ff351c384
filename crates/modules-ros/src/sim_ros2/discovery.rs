//! Which nodes are looked for: `ROS_AUTOMATIC_DISCOVERY_RANGE` and `ROS_STATIC_PEERS`, as nodes of Jazzy have them.

use std::net::{Ipv4Addr, SocketAddr, ToSocketAddrs};

use rtps::{Discovery, Range};
use script::RosOptions;

/// Whom a node with these options looks for, and what the user should know of it.
///
/// # Errors
/// When a setting is none.
pub(super) fn discovery(options: &RosOptions) -> Result<(Discovery, Vec<String>), String> {
    let range = range(&options.discovery_range)?;
    let (mut static_peers, mut warnings) = (Vec::new(), Vec::new());
    for name in options.static_peers.split(';').map(str::trim) {
        match peer(name, options.network.is_some()) {
            Ok(address) => static_peers.extend(address),
            Err(problem) => warnings.push(format!("ROS 2: {problem}")),
        }
    }
    let discovery = Discovery {
        range,
        static_peers,
    };
    Ok((discovery, warnings))
}

/// Case does not matter, as in ROS.
fn range(name: &str) -> Result<Range, String> {
    match name.to_ascii_uppercase().as_str() {
        "" | "SUBNET" | "SYSTEM_DEFAULT" => Ok(Range::Subnet),
        "LOCALHOST" => Ok(Range::Localhost),
        "OFF" => Ok(Range::Off),
        _ => Err(format!(
            "ROS_AUTOMATIC_DISCOVERY_RANGE is '{name}', expected SUBNET, LOCALHOST, OFF or SYSTEM_DEFAULT"
        )),
    }
}

/// The address of a static peer; none of an empty name. Names are looked up only where the network may be used.
fn peer(name: &str, may_leave: bool) -> Result<Option<Ipv4Addr>, String> {
    if name.is_empty() {
        return Ok(None);
    }
    let is_outside = |ip: &Ipv4Addr| !may_leave && !ip.is_loopback();
    let outside = || {
        Err(format!(
            "'{name}' of ROS_STATIC_PEERS is outside of this machine (--ros-network allows that)"
        ))
    };
    match name.parse::<Ipv4Addr>() {
        Ok(ip) if is_outside(&ip) => outside(),
        Ok(ip) => Ok(Some(ip)),
        Err(_) if name == "localhost" => Ok(Some(Ipv4Addr::LOCALHOST)),
        Err(_) if !may_leave => outside(),
        Err(_) => looked_up(name).map(Some),
    }
}

fn looked_up(name: &str) -> Result<Ipv4Addr, String> {
    let found = (name, 0)
        .to_socket_addrs()
        .map_err(|error| error.to_string());
    let address = found.and_then(|mut addresses| {
        let ip = addresses.find_map(|address| match address {
            SocketAddr::V4(address) => Some(*address.ip()),
            SocketAddr::V6(_) => None,
        });
        ip.ok_or_else(|| "it has no address of IPv4".to_owned())
    });
    address.map_err(|problem| format!("'{name}' of ROS_STATIC_PEERS is left out: {problem}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(range: &str, peers: &str, network: Option<Ipv4Addr>) -> RosOptions {
        RosOptions {
            discovery_range: range.into(),
            static_peers: peers.into(),
            network,
            ..RosOptions::default()
        }
    }

    #[test]
    fn settings_are_those_of_ros() {
        let anywhere = Some(Ipv4Addr::UNSPECIFIED);
        let (discovery, warnings) =
            discovery(&of("localhost", " 10.0.0.5;127.0.0.2;;localhost", anywhere))
                .expect("a range");
        let peers = [
            Ipv4Addr::new(10, 0, 0, 5),
            Ipv4Addr::new(127, 0, 0, 2),
            Ipv4Addr::LOCALHOST,
        ];
        assert_eq!(
            (discovery.range, discovery.static_peers),
            (Range::Localhost, peers.to_vec())
        );
        assert_eq!(warnings, [""; 0]);
    }

    #[test]
    fn nothing_is_outside_of_the_machine_unless_the_network_is_allowed() {
        let (discovery, warnings) =
            discovery(&of("", "10.0.0.5;127.0.0.2;robot.example", None)).expect("a range");
        assert_eq!(discovery.static_peers, [Ipv4Addr::new(127, 0, 0, 2)]);
        let expected = ["10.0.0.5", "robot.example"].map(|name| {
            format!("ROS 2: '{name}' of ROS_STATIC_PEERS is outside of this machine (--ros-network allows that)")
        });
        assert_eq!(warnings, expected);
    }

    #[test]
    fn other_ranges_are_errors() {
        let error = discovery(&of("EVERYWHERE", "", None)).expect_err("no range");
        assert!(
            error.contains("EVERYWHERE") && error.contains("SUBNET"),
            "{error}"
        );
    }
}
