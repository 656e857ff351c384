//! Paths and places, allowed and not.

use std::fs;

use super::*;

fn text<T>(result: Result<T, Denied>) -> String {
    result
        .err()
        .map(|denied| denied.to_string())
        .unwrap_or_default()
}

#[test]
fn sets() {
    assert!(Permissions::all().is_all() && Permissions::default().is_all());
    assert!(!Permissions::none().is_all() && !Permissions::strict().is_all());
    let everything = Permissions::none()
        .allow_read_everywhere()
        .allow_write_everywhere()
        .allow_net_everywhere();
    assert!(!everything.is_all() && everything.clone().allow_run().allow_native().is_all());
    assert_eq!(everything.check_environment(), Ok(()));
    assert_eq!(everything.check_redirect("a link"), Ok(()));
}

#[test]
fn refusals_name_the_option() {
    let none = Permissions::none();
    let path = Path::new("/nowhere/file");
    assert_eq!(
        text(none.check_read(path)),
        "reading '/nowhere/file' is not allowed: run with --allow-read=/nowhere"
    );
    assert_eq!(
        text(none.check_write(path)),
        "writing '/nowhere/file' is not allowed: run with --allow-write=/nowhere"
    );
    assert_eq!(
        text(none.check_inspect(path)),
        "reading '/nowhere/file' is not allowed: run with --allow-read=/nowhere/file"
    );
    assert_eq!(
        text(none.check_run("ls -l")),
        "running 'ls -l' is not allowed: run with --allow-run"
    );
    assert_eq!(
        text(none.check_native("bytecode")),
        "bytecode is not allowed: run with --allow-native"
    );
    assert_eq!(
        text(none.check_net("::1", Some(80))),
        "the network at '[::1]:80' is not allowed: run with --allow-net=[::1]:80"
    );
    assert_eq!(
        std::io::Error::from(none.check_read(path).unwrap_err()).kind(),
        std::io::ErrorKind::PermissionDenied
    );
}

#[test]
fn the_folder_of_the_scene() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("a.lua");
    assert!(Permissions::strict().check_read(&file).is_err());
    assert_eq!(
        Permissions::strict()
            .of_scene(folder.path())
            .check_read(&file),
        Ok(())
    );
    assert!(
        Permissions::strict()
            .of_scene(folder.path())
            .check_write(&file)
            .is_err()
    );
    assert!(
        Permissions::none()
            .of_scene(folder.path())
            .check_read(&file)
            .is_err()
    );
}

#[test]
fn dots_do_not_lead_out() {
    let above = tempfile::tempdir().unwrap();
    let folder = above.path().join("in");
    fs::create_dir_all(folder.join("deep")).unwrap();
    let allowed = Permissions::none().allow_read(&folder);
    for inside in [
        "x",
        "deep/../x",
        "missing/x",
        "./x",
        "../in/x",
        "missing/../x",
        "",
    ] {
        assert_eq!(allowed.check_read(&folder.join(inside)), Ok(()), "{inside}");
    }
    for outside in ["../x", "deep/../../x", "missing/../../x", "..", "../in2/x"] {
        assert!(
            allowed.check_read(&folder.join(outside)).is_err(),
            "{outside}"
        );
        assert!(
            allowed.check_inspect_link(&folder.join(outside)).is_err(),
            "{outside}"
        );
    }
    let refusal = text(allowed.check_read(&folder.join("deep/../../x/y")));
    assert!(
        refusal.ends_with(&format!(
            "--allow-read={}",
            above.path().join("x").display()
        )),
        "{refusal}"
    );
}

#[cfg(unix)]
#[test]
fn links_do_not_lead_out() {
    use std::os::unix::fs::symlink;
    let above = tempfile::tempdir().unwrap();
    let (folder, other) = (above.path().join("in"), above.path().join("out"));
    fs::create_dir_all(&folder).unwrap();
    fs::create_dir_all(&other).unwrap();
    symlink(&other, folder.join("folder")).unwrap();
    symlink("../out/not there yet", folder.join("dangling")).unwrap();
    symlink("inner", folder.join("inner link")).unwrap();
    symlink("round", folder.join("round")).unwrap();
    let allowed = Permissions::none().allow_write(&folder).allow_read(&folder);
    for outside in ["folder", "folder/x", "dangling", "folder/../x", "round"] {
        assert!(
            allowed.check_write(&folder.join(outside)).is_err(),
            "{outside}"
        );
    }
    assert_eq!(allowed.check_write(&folder.join("inner link")), Ok(()));
    let link = folder.join("dangling");
    assert!(
        text(allowed.check_write(&link)).ends_with(&format!("--allow-write={}", link.display())),
        "of the link"
    );
    // The link itself lies in the folder.
    assert_eq!(allowed.check_write_entry(&folder.join("folder")), Ok(()));
    for through in ["folder/", "folder/.", "folder/..", "folder/x"] {
        assert!(
            allowed.check_write_entry(&folder.join(through)).is_err(),
            "{through}"
        );
    }
    assert!(
        allowed
            .check_rename(&other.join("x"), &folder.join("x"))
            .is_err()
    );
    // A folder that is named by a link is the one it leads to.
    let by_link = Permissions::none().allow_read(folder.join("folder"));
    assert_eq!(by_link.check_read(&other.join("x")), Ok(()));
}

#[test]
fn hosts_and_ports() {
    let rule = |text: &str| text.parse::<HostRule>();
    let allowed = |rules: &[&str]| {
        rules.iter().fold(Permissions::none(), |allowed, text| {
            allowed.allow_net(rule(text).expect("well-formed"))
        })
    };
    let one = allowed(&["127.0.0.1:80", "Example.org", "[::1]:9"]);
    for (host, port) in [
        ("127.0.0.1", 80),
        ("example.ORG", 1),
        ("example.org.", 2),
        ("::1", 9),
        ("0:0::1", 9),
    ] {
        assert_eq!(one.check_net(host, Some(port)), Ok(()), "{host}:{port}");
    }
    for (host, port) in [
        ("127.0.0.1", 81),
        ("localhost", 80),
        ("a.example.org", 1),
        ("::1", 8),
        ("0.0.0.0", 80),
    ] {
        assert!(one.check_net(host, Some(port)).is_err(), "{host}:{port}");
    }
    assert_eq!(one.check_net("example.org", None), Ok(()));
    assert_eq!(one.check_net("127.0.0.1", None), Ok(()), "a lookup");
    assert!(one.check_net("127.0.0.2", None).is_err());
    assert!(one.check_net_everywhere("all").is_err());
    assert_eq!(rule("::1"), Ok(HostRule::new("::1", None)));
    for wrong in ["", ":80", "host:", "host:port", "host:99999", "a:b:1"] {
        assert!(rule(wrong).is_err(), "{wrong}");
    }
}
