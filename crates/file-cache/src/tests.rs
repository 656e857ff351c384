//! Files that are damaged, foreign, too many, or written by several at once.

use super::*;

const LIMIT: u64 = 1 << 16;

fn key(of: &str) -> Key {
    Key::of(&[of.as_bytes()])
}

fn cache() -> (tempfile::TempDir, FileCache) {
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    let cache = FileCache::new(folder.path().join("new"), LIMIT);
    (folder, cache)
}

#[test]
fn keys_tell_parts_apart() {
    let first = Key::of(&[b"ab", b"c"]);
    assert_ne!(first, Key::of(&[b"a", b"bc"]));
    assert_ne!(first, Key::of(&[b"abc"]));
    assert_eq!(first, Key::of(&[b"ab", b"c"]));
    assert_eq!(first.to_string().len(), 64);
}

#[test]
fn another_process_finds_what_was_put() {
    let (_folder, cache) = cache();
    cache.put(&[(key("a"), b"first".to_vec()), (key("b"), Vec::new())]);
    let other = cache.clone();
    assert_eq!(other.get(&key("a")).as_deref(), Some(b"first".as_slice()));
    assert_eq!(other.get(&key("b")).as_deref(), Some(b"".as_slice()));
    assert_eq!(other.get(&key("c")), None);
}

#[test]
fn each_damage_is_noticed_and_mended() {
    let (_folder, cache) = cache();
    cache.put(&[(key("a"), b"result".to_vec())]);
    let path = cache.path(&key("a"));
    let file = fs::read(&path).unwrap();
    for at in 0..file.len() {
        let mut damaged = file.clone();
        damaged[at] ^= 0x40;
        fs::write(&path, damaged).unwrap();
        assert_eq!(cache.get(&key("a")), None, "byte {at}");
        fs::write(&path, &file[..at]).unwrap();
        assert_eq!(cache.get(&key("a")), None, "only {at} bytes");
    }
    fs::write(&path, [&file[..], b"more"].concat()).unwrap();
    assert_eq!(cache.get(&key("a")), None);
    cache.put(&[(key("a"), b"result".to_vec())]);
    assert!(cache.get(&key("a")).is_some());
}

#[test]
fn a_file_under_a_wrong_name_is_not_taken() {
    let (_folder, cache) = cache();
    cache.put(&[(key("a"), b"result".to_vec())]);
    fs::rename(cache.path(&key("a")), cache.path(&key("b"))).unwrap();
    assert_eq!(cache.get(&key("b")), None);
}

#[test]
fn what_is_no_file_or_has_no_end_is_not_read() {
    let (_folder, cache) = cache();
    cache.put(&[(key("a"), b"result".to_vec())]);
    let huge = File::create(cache.path(&key("huge"))).unwrap();
    huge.set_len(1 << 40).unwrap();
    fs::create_dir(cache.path(&key("folder"))).unwrap();
    #[cfg(unix)]
    std::os::unix::fs::symlink("/dev/zero", cache.path(&key("link"))).unwrap();
    for name in ["huge", "folder", "link"] {
        assert_eq!(cache.get(&key(name)), None, "{name}");
    }
}

#[test]
fn the_folder_stays_small() {
    let (_folder, cache) = cache();
    let result = vec![7; 4000];
    for count in 0..100 {
        cache.put(&[(key(&count.to_string()), result.clone())]);
        let size: u64 = cache.files().unwrap().iter().map(|file| file.size).sum();
        assert!(size <= LIMIT, "{size} after {count}");
    }
    assert!(cache.get(&key("99")).is_some() && cache.get(&key("0")).is_none());
    cache.put(&[(key("large"), vec![0; LIMIT as usize])]);
    assert_eq!(cache.get(&key("large")), None);
    assert!(
        cache.get(&key("99")).is_some(),
        "for what is not kept nothing is removed"
    );
}

#[test]
fn what_writers_left_is_removed_too() {
    let (_folder, cache) = cache();
    cache.put(&[(key("a"), b"result".to_vec())]);
    let left = cache.folder.join(".tmpAbCdEf");
    fs::write(&left, vec![0; LIMIT as usize]).unwrap();
    cache.put(&[(key("b"), b"result".to_vec())]);
    assert!(!left.exists());
}

#[test]
fn where_nothing_can_be_written_nothing_is_kept() {
    let (folder, cache) = cache();
    cache
        .clone()
        .read_only()
        .put(&[(key("a"), b"result".to_vec())]);
    assert!(!cache.folder.exists());
    fs::write(&cache.folder, "a file where the folder should be").unwrap();
    cache.put(&[(key("a"), b"result".to_vec())]);
    assert_eq!(cache.get(&key("a")), None);
    assert_eq!(folder.path().read_dir().unwrap().count(), 1);
}

#[cfg(unix)]
#[test]
fn only_the_user_may_read_and_write() {
    use std::os::unix::fs::PermissionsExt;
    let (_folder, cache) = cache();
    cache.put(&[(key("a"), b"result".to_vec())]);
    let mode = |path: &Path| fs::metadata(path).unwrap().permissions().mode() & 0o777;
    assert_eq!(mode(&cache.folder), 0o700);
    assert_eq!(mode(&cache.path(&key("a"))), 0o600);
}

#[test]
fn processes_write_and_read_at_the_same_time() {
    let (_folder, cache) = cache();
    let results: Vec<_> = (0..8u8)
        .map(|n| (key(&n.to_string()), vec![n; 3000]))
        .collect();
    std::thread::scope(|scope| {
        for _ in 0..4 {
            scope.spawn(|| {
                for _ in 0..20 {
                    cache.put(&results);
                    for (key, result) in &results {
                        let found = cache.get(key);
                        assert!(found.is_none_or(|found| found == *result));
                    }
                }
            });
        }
    });
}
