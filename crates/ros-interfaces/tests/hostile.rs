//! Texts and bytes that are wrong, too long, or meant to exhaust memory.

use ros_interfaces::parse::parse;
use ros_interfaces::{
    Catalogue, DecodeError, Generation, InterfaceError, InterfaceKind, Record, TypeName, Value,
    cdr, limits, ros1,
};
use test_support::random::Random;

fn message(name: &str) -> TypeName {
    TypeName::parse(name, InterfaceKind::Message).expect("a name")
}

fn problem(text: &str, generation: Generation) -> String {
    parse(&message("p/T"), text, generation, "T.msg")
        .expect_err("an error")
        .to_string()
}

#[test]
fn errors_name_file_and_line() {
    let ros2 = |text: &str| problem(text, Generation::Ros2);
    assert_eq!(
        ros2("# a comment\nint32 x\nint33 y"),
        "T.msg:3: 'int33' is no type"
    );
    assert_eq!(ros2("int32"), "T.msg:1: 'int32' is a type without a name");
    assert_eq!(
        ros2("int8 X=200"),
        "T.msg:1: '200' is no value of int8 for constant 'X'"
    );
    assert_eq!(ros2("int32 x\nint32 x"), "T.msg:2: there is a 'x' already");
    assert_eq!(ros2("int32 9x"), "T.msg:1: '9x' is no name");
    assert_eq!(ros2("int32[x] y"), "T.msg:1: 'x' is no length");
    assert_eq!(
        ros2("int32[4294967295] y"),
        "T.msg:1: an array of 4294967295 elements is too long"
    );
    assert_eq!(ros2("a/../b x"), "T.msg:1: 'a/../b' is no type");
    assert_eq!(
        ros2("int32[] x [1, 2"),
        "T.msg:1: '[1, 2' is no value of int32[] for field 'x'"
    );
    assert_eq!(ros2("time t"), "T.msg:1: 'time' is no type");
    assert_eq!(
        ros2("int32 x\n---\nint32 y"),
        "T.msg:3: 2 parts between lines of ---, where 1 are expected"
    );
    assert_eq!(
        problem("int32 x 5", Generation::Ros1),
        "T.msg:1: '5' after the name of a field"
    );
    assert_eq!(
        problem("wstring x", Generation::Ros1),
        "T.msg:1: 'wstring' is no type"
    );
    let long = " ".repeat(limits::TEXT + 1);
    assert!(ros2(&long).contains("more than"));
    let many: String = (0..=limits::MEMBERS)
        .map(|n| format!("bool b{n}\n"))
        .collect();
    assert!(ros2(&many).contains("4096 fields"));
}

#[test]
fn types_that_contain_themselves_or_too_much_are_refused() {
    let mut catalogue = Catalogue::new(Generation::Ros2);
    let mut add =
        |name: &str, text: &str| catalogue.add_text(&message(name), text).expect("a text");
    add("p/A", "B[] b");
    add("p/B", "A a");
    add("p/D0", "bool x");
    for n in 1..40 {
        add(&format!("p/D{n}"), &format!("D{0}[] x\nD{0}[] y", n - 1));
    }
    add("p/F", "float64[4000000] x");
    add("p/G", "F[4000000] x");
    add("p/M", "no_such/Thing x");
    let mut error = |name: &str| catalogue.layout(name).expect_err("an error");
    assert_eq!(error("p/A"), InterfaceError::Cycle("p/msg/A".into()));
    assert_eq!(error("p/D39"), InterfaceError::Nesting("p/msg/D39".into()));
    assert_eq!(error("p/G"), InterfaceError::TooLarge("p/msg/G".into()));
    assert_eq!(
        error("p/M").to_string(),
        "p/msg/M has a field of type no_such/msg/Thing: unknown interface 'no_such/msg/Thing'"
    );
    assert_eq!(error("p/msg/x/y"), InterfaceError::Name("p/msg/x/y".into()));
    assert!(matches!(error("../etc/passwd"), InterfaceError::Name(_)));
    // 2^25 ways lead to the innermost type, which is described once.
    let deep = catalogue.layout("p/D25").expect("nested 25 levels deep");
    assert_eq!(ros1::md5(&deep).len(), 32);
    assert!(ros1::definition(&deep).len() < 5000);
}

#[test]
fn types_that_are_nested_in_very_many_ways_cost_no_time() {
    let mut catalogue = Catalogue::new(Generation::Ros1);
    let mut add =
        |name: &str, text: &str| catalogue.add_text(&message(name), text).expect("a text");
    add("p/D0", "bool x");
    add("p/E0", "bool x");
    for n in 1..31 {
        let fields = |name: char, shape: &str| -> String {
            (0..8)
                .map(|field| format!("{name}{}{shape} f{field}\n", n - 1))
                .collect()
        };
        add(&format!("p/D{n}"), &fields('D', "[]"));
        add(&format!("p/E{n}"), &fields('E', "[0]"));
    }
    // 8^30 ways lead to the innermost types.
    let deep = catalogue.layout("p/D30").expect("30 levels");
    assert!(ros1::decode(&deep, &[0; 32]).is_ok());
    assert!(ros1::decode(&deep, &[1; 32]).is_err());
    let empty = catalogue.layout("p/E30").expect("30 levels");
    assert!(ros1::decode(&empty, &[]).is_ok());
}

#[test]
fn arrays_of_no_elements_do_not_exhaust_memory() {
    for generation in [Generation::Ros1, Generation::Ros2] {
        let mut catalogue = Catalogue::new(generation);
        let arrays: String = (0..4000).map(|n| format!("uint8[0] f{n}\n")).collect();
        catalogue
            .add_text(&message("p/Empty"), &format!("uint8 x\n{arrays}"))
            .expect("a text");
        catalogue
            .add_text(&message("p/Many"), "Empty[] all")
            .expect("a text");
        let many = catalogue.layout("p/Many").expect("a type");
        // Each record has one byte, and 4001 values.
        let bytes = [&100_000_u32.to_le_bytes()[..], &[7; 100_000]].concat();
        assert_eq!(ros1::decode(&many, &bytes), Err(DecodeError::Records));
        assert_eq!(
            cdr::decode(&many, &[&[0, 1, 0, 0], &bytes[..]].concat()),
            Err(DecodeError::Records)
        );
    }
}

#[test]
fn lengths_are_checked_before_memory_is_allocated() {
    let mut catalogue = Catalogue::new(Generation::Ros1);
    let much = u32::MAX.to_le_bytes();
    for name in [
        "std_msgs/String",
        "nav_msgs/Path",
        "tf2_msgs/TFMessage",
        "std_msgs/Float64MultiArray",
        "shape_msgs/Mesh",
    ] {
        let layout = catalogue.layout(name).expect("a type");
        assert!(ros1::decode(&layout, &much.repeat(6)).is_err(), "{name}");
    }
    catalogue
        .add_text(&message("p/Many"), "std_msgs/Empty[] all")
        .expect("a text");
    let many = catalogue.layout("p/Many").expect("a type");
    assert_eq!(ros1::decode(&many, &much), Err(DecodeError::Records));
}

#[test]
fn messages_that_are_cut_off_or_too_long_are_refused() {
    let mut catalogue = Catalogue::new(Generation::Ros1);
    let layout = catalogue
        .layout("geometry_msgs/TransformStamped")
        .expect("a type");
    let mut record = Record::new(&layout);
    record
        .set("child_frame_id", Value::String(b"base".to_vec()))
        .expect("a string");
    let bytes = ros1::encode(&record);
    assert_eq!(ros1::decode(&layout, &bytes), Ok(record));
    for length in 0..bytes.len() {
        assert!(ros1::decode(&layout, &bytes[..length]).is_err());
    }
    assert_eq!(
        ros1::decode(&layout, &[&bytes[..], b"x"].concat()),
        Err(DecodeError::Long { rest: 1 })
    );
}

#[test]
fn damaged_messages_are_read_or_refused() {
    let mut catalogue = Catalogue::new(Generation::Ros1);
    let mut random = Random::new(1);
    let mut read = 0;
    for name in [
        "nav_msgs/Path",
        "visualization_msgs/InteractiveMarkerUpdate",
        "sensor_msgs/PointCloud2",
        "rosgraph_msgs/Log",
    ] {
        let layout = catalogue.layout(name).expect("a type");
        let sound = ros1::encode(&Record::new(&layout));
        for _ in 0..5000 {
            let mut bytes = sound.clone();
            for _ in 0..3 {
                // Mostly small numbers, which are lengths that could be.
                let place = random.below(bytes.len().min(256));
                bytes[place] = random.below(8) as u8;
            }
            let more = random.below(32);
            bytes.extend((0..more).map(|_| random.below(4) as u8));
            if let Ok(record) = ros1::decode(&layout, &bytes) {
                assert_eq!(ros1::encode(&record).len(), bytes.len());
                read += 1;
            }
        }
    }
    assert!(read > 0, "some damaged messages are sound");
}
