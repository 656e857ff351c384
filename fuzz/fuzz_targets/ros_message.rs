//! Any text as a type of ROS 1 or ROS 2, and any bytes as a message of it and of types that nest others: read or refused; what is read
//! is written to the same bytes, unless a truth value had another byte than 0 or 1.
//!
//! `cargo fuzz run ros_message`
#![no_main]

use std::sync::LazyLock;

use libfuzzer_sys::fuzz_target;
use ros_interfaces::{Catalogue, Generation, InterfaceKind, TypeName, ros1};

const TYPES: &[&str] = &["p/T", "nav_msgs/Path", "visualization_msgs/InteractiveMarkerUpdate", "std_msgs/Float64MultiArray"];

/// With the built-in types, which take far longer to read than an input.
static CATALOGUES: LazyLock<[Catalogue; 2]> =
    LazyLock::new(|| [Generation::Ros1, Generation::Ros2].map(Catalogue::new));

fuzz_target!(|input: (bool, &str, &[u8])| {
    let (second, text, bytes) = input;
    let mut catalogue = CATALOGUES[usize::from(second)].clone();
    let name = TypeName::new("p", InterfaceKind::Message, "T").expect("a name");
    if catalogue.add_text(&name, text).is_err() {
        return;
    }
    for name in TYPES {
        let Ok(layout) = catalogue.layout(name) else { continue };
        assert_eq!(ros1::md5(&layout).len(), 32);
        assert!(!ros1::definition(&layout).contains('\0') || text.contains('\0'));
        if let Ok(record) = ros1::decode(&layout, bytes) {
            let written = ros1::encode(&record);
            assert_eq!(written.len(), bytes.len());
            let again = ros1::decode(&layout, &written).expect("what was written");
            assert_eq!(ros1::encode(&again), written);
        }
    }
});
