//! What texts of interfaces mean.

use std::fs;

use ros_interfaces::{
    Array, Catalogue, Generation, InterfaceKind, Number, Numbers, Record, Shape, TypeName, Value,
};

fn with(generation: Generation, kind: InterfaceKind, text: &str) -> Catalogue {
    let mut catalogue = Catalogue::new(generation);
    catalogue
        .add_text(&TypeName::new("p", kind, "T").expect("a name"), text)
        .expect("a text");
    catalogue
}

fn strings(all: &[&str]) -> Value {
    Value::Array(Array::Strings(
        all.iter().map(|text| text.as_bytes().to_vec()).collect(),
    ))
}

#[test]
fn defaults_bounds_and_comments_of_ros_2() {
    let text = "
        # nothing
        int32 X = 0x10   # sixteen
        string NAME = \"a # b\" # a comment
        float64 y -1.5
        string<=5 short 'it\\'s'
        string word hello
        int32[] numbers [1, -2,3 ]
        string[<=2] names [\"a, b\", 'c']
        bool[2] pair [true, false]
        wstring wide
        uint8[3] bytes
        geometry_msgs/Point[<=4] points # many
        geometry_msgs/msg/Point point
    ";
    let mut catalogue = with(Generation::Ros2, InterfaceKind::Message, text);
    let layout = catalogue.layout("p/msg/T").expect("a type");
    assert_eq!(layout.constants[0].value, Value::Number(Number::Int32(16)));
    assert_eq!(layout.constants[1].value, Value::String(b"a # b".to_vec()));
    let record = Record::new(&layout);
    let get = |name: &str| record.get(name).expect("a field").clone();
    assert_eq!(get("y"), Value::Number(Number::Float64(-1.5)));
    assert_eq!(get("short"), Value::String(b"it's".to_vec()));
    assert_eq!(get("word"), Value::String(b"hello".to_vec()));
    assert_eq!(
        get("numbers"),
        Value::Array(Array::Numbers(Numbers::Int32(vec![1, -2, 3])))
    );
    assert_eq!(get("names"), strings(&["a, b", "c"]));
    assert_eq!(
        get("pair"),
        Value::Array(Array::Numbers(Numbers::Bool(vec![true, false])))
    );
    assert_eq!(
        get("bytes"),
        Value::Array(Array::Numbers(Numbers::UInt8(vec![0; 3])))
    );
    assert_eq!(
        layout.field("points").expect("a field").1.field_type.shape,
        Shape::Sequence(Some(4))
    );
    let mut record = record;
    assert!(
        record
            .set("short", Value::String(b"123456".to_vec()))
            .is_err()
    );
    assert!(
        record
            .set(
                "pair",
                Value::Array(Array::Numbers(Numbers::Bool(vec![true])))
            )
            .is_err()
    );
    assert!(record.set("names", strings(&["a", "b", "c"])).is_err());
    let error = record
        .set("word", Value::Number(Number::Int8(1)))
        .expect_err("another type");
    assert_eq!(error.to_string(), "p/msg/T: field word: expected string");
}

#[test]
fn strings_header_and_times_of_ros_1() {
    let text =
        "string S= a \"quoted\" # text \nHeader header\ntime t\nduration[] d\nbyte b\nchar c";
    let layout = with(Generation::Ros1, InterfaceKind::Message, text)
        .layout("p/T")
        .expect("a type");
    assert_eq!(
        layout.constants[0].value,
        Value::String(b"a \"quoted\" # text".to_vec())
    );
    assert_eq!(layout.fields[0].field_type.to_string(), "std_msgs/Header");
    assert_eq!(
        Record::new(&layout).get("c"),
        Some(&Value::Number(Number::UInt8(0)))
    );
}

#[test]
fn parts_of_services_and_actions_have_names() {
    let mut catalogue = Catalogue::new(Generation::Ros2);
    for (name, canonical, fields) in [
        (
            "std_srvs/srv/SetBoolRequest",
            "std_srvs/srv/SetBool_Request",
            "data",
        ),
        (
            "std_srvs/srv/SetBool_Response",
            "std_srvs/srv/SetBool_Response",
            "success,message",
        ),
        (
            "std_srvs/srv/SetBool_Event",
            "std_srvs/srv/SetBool_Event",
            "info,request,response",
        ),
        (
            "example_interfaces/action/FibonacciGoal",
            "example_interfaces/action/Fibonacci_Goal",
            "order",
        ),
        (
            "example_interfaces/action/Fibonacci_SendGoal_Request",
            "example_interfaces/action/Fibonacci_SendGoal_Request",
            "goal_id,goal",
        ),
        (
            "example_interfaces/action/Fibonacci_FeedbackMessage",
            "example_interfaces/action/Fibonacci_FeedbackMessage",
            "goal_id,feedback",
        ),
    ] {
        let layout = catalogue.layout(name).expect("a type");
        assert_eq!(layout.name.to_string(), canonical);
        let names: Vec<&str> = layout
            .fields
            .iter()
            .map(|field| field.name.as_str())
            .collect();
        assert_eq!(names.join(","), fields);
    }
    assert!(catalogue.layout("std_srvs/srv/SetBool").is_err());
    assert!(catalogue.service("std_srvs/SetBool").is_ok());
    assert!(catalogue.service("std_srvs/srv/SetBoolean").is_err());
}

#[test]
fn a_quaternion_of_ros_2_is_a_rotation_and_one_of_ros_1_is_zero() {
    for (generation, w) in [(Generation::Ros1, 0.0), (Generation::Ros2, 1.0)] {
        let layout = Catalogue::new(generation)
            .layout("geometry_msgs/msg/Quaternion")
            .expect("a type");
        assert_eq!(
            Record::new(&layout).get("w"),
            Some(&Value::Number(Number::Float64(w)))
        );
    }
}

#[test]
fn files_are_found_in_prefixes_workspaces_and_packages() {
    let root = std::env::temp_dir().join(format!("swanilda-ros-interfaces-{}", std::process::id()));
    let write = |path: &str, text: &str| {
        let path = root.join(path);
        fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        fs::write(path, text).expect("a file");
    };
    write("prefix/share/a_msgs/msg/A.msg", "int32 x\nB b");
    write("prefix/share/a_msgs/msg/B.msg", "int32 y");
    write(
        "workspace/src/group/b_msgs/srv/Do.srv",
        "a_msgs/A a\n---\nbool ok",
    );
    write("c_msgs/msg/Broken.msg", "int32 x\nwhat");
    let mut catalogue = Catalogue::new(Generation::Ros2);
    for folder in ["prefix", "workspace", "c_msgs", "absent"] {
        catalogue.add_folder(root.join(folder));
    }
    assert_eq!(
        catalogue.layout("a_msgs/A").expect("a type").fields.len(),
        2
    );
    assert_eq!(
        catalogue.service("b_msgs/Do").expect("a service")[0].fields[0].name,
        "a"
    );
    let error = catalogue
        .layout("c_msgs/Broken")
        .expect_err("an error")
        .to_string();
    assert!(
        error.ends_with("Broken.msg:2: 'what' is a type without a name"),
        "{error}"
    );
    let names: Vec<String> = catalogue.names().iter().map(ToString::to_string).collect();
    for name in ["a_msgs/msg/A", "b_msgs/srv/Do", "c_msgs/msg/Broken"] {
        assert!(names.contains(&name.to_string()), "{name}");
    }
    fs::remove_dir_all(&root).expect("the folder is ours");
}
