//! The built-in descriptions: every type is there with everything in it, and ROS 1's have the MD5 sums that its nodes compare.

use ros_interfaces::{Catalogue, Generation, InterfaceKind, Record, ros1};

/// Name and MD5 sum of the types of Noetic, as the Python packages of Debian 12 and rosbags 0.11 state them.
const SUMS: &str = include_str!("md5.tsv");

#[test]
fn every_type_of_ros_1_has_the_md5_sum_that_its_nodes_expect() {
    let mut catalogue = Catalogue::new(Generation::Ros1);
    let mut wrong = Vec::new();
    for (name, sum) in SUMS
        .lines()
        .map(|line| line.split_once('\t').expect("name and sum"))
    {
        let ours = if name.contains("/srv/") {
            catalogue
                .service(name)
                .map(|[request, response]| ros1::service_md5(&request, &response))
        } else {
            catalogue.layout(name).map(|layout| ros1::md5(&layout))
        };
        if ours.as_deref() != Ok(sum) {
            wrong.push(format!("{name}: {ours:?}"));
        }
    }
    assert_eq!(wrong, Vec::<String>::new());
    assert!(SUMS.lines().count() > 150);
}

#[test]
fn every_type_is_closed_under_nesting_and_has_default_values() {
    for generation in [Generation::Ros1, Generation::Ros2] {
        let mut catalogue = Catalogue::new(generation);
        let names = catalogue.names();
        assert!(names.len() > 150, "{}", names.len());
        for name in names {
            let parts: &[&str] = match name.kind {
                InterfaceKind::Message => &[""],
                InterfaceKind::Service => &["_Request", "_Response"],
                InterfaceKind::Action => &["_Goal", "_Result", "_Feedback"],
            };
            for part in parts {
                let layout = catalogue.layout(&format!("{name}{part}")).expect("a type");
                let record = Record::new(&layout);
                assert_eq!(record.values().len(), layout.fields.len());
                if generation == Generation::Ros1 {
                    let bytes = ros1::encode(&record);
                    assert_eq!(ros1::decode(&layout, &bytes), Ok(record), "{name}");
                }
            }
        }
    }
}
