use super::*;
use std::fs;
use std::path::PathBuf;

/// A new folder that is removed when the test ends.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let name = format!("ccd-file-{name}-{}", std::process::id());
        let folder = std::env::temp_dir().join(name);
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).unwrap();
        Folder(folder)
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }

    fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(&self.0).unwrap();
        let name = |entry: fs::DirEntry| entry.file_name().into_string().unwrap();
        let mut names: Vec<String> = entries.map(|entry| name(entry.unwrap())).collect();
        names.sort_unstable();
        names
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

fn read_text(path: &Path) -> String {
    fs::read_to_string(path).unwrap()
}

/// Writes a few bytes, and then fails as on a full disk.
fn write_until_full(out: &mut dyn Write) -> io::Result<()> {
    out.write_all(b"half")?;
    out.flush()?;
    Err(io::ErrorKind::StorageFull.into())
}

#[test]
fn a_write_that_fails_leaves_the_older_file() {
    let folder = Folder::new("fails");
    let file = folder.path("good");
    fs::write(&file, "good").unwrap();
    let error = write(&file, write_until_full).unwrap_err();
    assert_eq!(error.kind(), io::ErrorKind::StorageFull);
    assert_eq!(read_text(&file), "good");
    assert!(write(folder.path("new"), write_until_full).is_err());
    assert_eq!(folder.names(), ["good"]);
    write(&file, |out| out.write_all(b"better")).unwrap();
    assert_eq!(read_text(&file), "better");
    assert_eq!(folder.names(), ["good"]);
    for bad in [folder.0.clone(), folder.path("none/x"), "".into()] {
        assert!(write(&bad, |_| Ok(())).is_err(), "{}", bad.display());
    }
}

/// Tests that what a killed process left is removed, and nothing else: not what is being written, nor files of other names.
#[test]
fn abandoned_temporary_files_are_removed() {
    let folder = Folder::new("abandoned");
    let (left, own) = (folder.path("page.77-0.part"), folder.path("notes.part"));
    let busy = folder.path("page.78-0.part");
    for file in [&left, &own, &busy, &folder.path("x.7-a.part")] {
        fs::write(file, "half").unwrap();
    }
    let lock = fs::File::options().write(true).open(&busy).unwrap();
    lock.try_lock().unwrap();
    write(folder.path("page"), |out| out.write_all(b"whole")).unwrap();
    assert_eq!(
        folder.names(),
        ["notes.part", "page", "page.78-0.part", "x.7-a.part"]
    );
}

#[test]
fn a_file_is_read_whole_and_a_folder_is_none() {
    let folder = Folder::new("read");
    let file = folder.path("text");
    fs::write(&file, "whole").unwrap();
    assert_eq!(read(&file).unwrap(), b"whole");
    assert_eq!(read_to_string(&file).unwrap(), "whole");
    fs::write(&file, b"\xff").unwrap();
    let error = read_to_string(&file).unwrap_err();
    assert_eq!(error.kind(), io::ErrorKind::InvalidData);
    let error = read(&folder.0).unwrap_err();
    assert_eq!(error.kind(), io::ErrorKind::IsADirectory);
    let error = open(folder.path("none")).unwrap_err();
    assert_eq!(error.kind(), io::ErrorKind::NotFound);
    // Sparse: no memory is as large.
    let long = fs::File::create(&file).unwrap();
    long.set_len(MAX_FILE_BYTES + 1).unwrap();
    assert_eq!(read(&file).unwrap_err().kind(), io::ErrorKind::FileTooLarge);
}

#[test]
fn a_claimed_file_is_given_to_one() {
    let folder = Folder::new("claimed");
    let target = folder.path("table");
    let claim = |path: PathBuf| match Destination::resolve(&path)? {
        Destination::File(target) => Claim::new(target),
        Destination::Stream => panic!("it is a file"),
    };
    let mut first = claim(target.clone()).unwrap();
    for other in ["table", "./table", "../{}/table"] {
        let own = folder.0.file_name().unwrap().to_str().unwrap();
        let error = claim(folder.path(&other.replace("{}", own))).unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::ResourceBusy, "{other}");
    }
    first.file().write_all(b"rows").unwrap();
    first.rename_to_target().unwrap();
    assert_eq!(read_text(&target), "rows");
    assert_eq!(folder.names(), ["table"]);

    // Dropped: removed, unless it is kept or was there before.
    drop(claim(target.clone()).unwrap());
    assert_eq!(folder.names(), ["table"]);
    let mut kept = claim(target.clone()).unwrap();
    kept.file().write_all(b"more rows").unwrap();
    kept.keep_on_drop();
    drop(kept);
    drop(claim(target.clone()).unwrap());
    let mut again = claim(target.clone()).unwrap();
    assert_eq!(again.initial_length(), 9);
    again.truncate(4).unwrap();
    again.file().write_all(b"over").unwrap();
    again.rename_to_target().unwrap();
    assert_eq!(read_text(&target), "moreover");
    assert!(
        claim(target.clone())
            .unwrap()
            .write(write_until_full)
            .is_err()
    );
    assert_eq!(
        (read_text(&target).as_str(), folder.names().len()),
        ("moreover", 1)
    );
    claim(target.clone())
        .unwrap()
        .write(|out| out.write_all(b"all"))
        .unwrap();
    assert_eq!(read_text(&target), "all");
}

/// Tests that a claimed file is not renamed to its target if its temporary file was removed or replaced.
#[test]
fn a_replaced_file_is_not_placed() {
    let folder = Folder::new("replaced");
    let target = folder.path("table");
    for replaced in [false, true] {
        let claim = Claim::new(target.clone()).unwrap();
        fs::remove_file(claim.partial_path()).unwrap();
        if replaced {
            fs::write(claim.partial_path(), "of another").unwrap();
        }
        let error = claim.rename_to_target().unwrap_err();
        assert!(error.to_string().contains("removed or replaced"), "{error}");
        assert!(!target.exists());
    }
    assert_eq!(folder.names(), ["table.partial"]);
}

/// Tests that of several threads only one at a time claims, writes and places the same file.
#[test]
fn threads_have_a_claimed_file_one_after_the_other() {
    let folder = Folder::new("in-turn");
    let target = folder.path("table");
    let claims = std::thread::scope(|scope| {
        let thread = |number: usize| {
            let target = &target;
            move || {
                let mut claims = 0;
                while claims < 50 {
                    let mut claim = match Claim::new(target.clone()) {
                        Ok(claim) => claim,
                        Err(error) if error.kind() == io::ErrorKind::ResourceBusy => {
                            std::thread::yield_now();
                            continue;
                        }
                        Err(error) => panic!("{error}"),
                    };
                    assert_eq!(claim.initial_length(), 0);
                    for _ in 0..10 {
                        claim.file().write_all(&[b'0' + number as u8]).unwrap();
                    }
                    claim.rename_to_target().unwrap();
                    let there = fs::read(target).unwrap();
                    assert!(there.len() == 10 && there.iter().all(|&b| b == there[0]));
                    claims += 1;
                }
                claims
            }
        };
        let threads: Vec<_> = (0..4).map(|number| scope.spawn(thread(number))).collect();
        threads
            .into_iter()
            .map(|thread| thread.join().unwrap())
            .sum::<usize>()
    });
    assert_eq!(claims, 4 * 50);
    assert_eq!(folder.names(), ["table"]);
}

#[cfg(unix)]
mod unix {
    use super::*;
    use std::os::unix::fs::{FileTypeExt, PermissionsExt, symlink};

    #[test]
    fn permissions_stay_and_links_are_followed() {
        let folder = Folder::new("links");
        let (target, link) = (folder.path("target"), folder.path("link"));
        fs::write(&target, "old").unwrap();
        fs::set_permissions(&target, fs::Permissions::from_mode(0o640)).unwrap();
        symlink("target", &link).unwrap();
        write(&link, |out| out.write_all(b"new")).unwrap();
        assert_eq!(read_text(&target), "new");
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        let mode = fs::metadata(&target).unwrap().permissions().mode();
        assert_eq!(mode & 0o777, 0o640);
        // A link to a file that is not there yet.
        let early = folder.path("early");
        symlink("late", &early).unwrap();
        write(&early, |out| out.write_all(b"late")).unwrap();
        assert_eq!(read_text(&folder.path("late")), "late");
        assert!(fs::symlink_metadata(&early).unwrap().is_symlink());
        let round = folder.path("round");
        symlink("round", &round).unwrap();
        assert!(write(&round, |_| Ok(())).is_err());
        assert_eq!(folder.names(), ["early", "late", "link", "round", "target"]);
    }

    #[test]
    fn what_may_never_end_is_not_read() {
        let folder = Folder::new("endless");
        let link = folder.path("part.stl");
        symlink("/dev/zero", &link).unwrap();
        let pipe = folder.path("pipe.stl");
        let made = std::process::Command::new("mkfifo").arg(&pipe).status();
        assert!(made.unwrap().success());
        for endless in [&link, &pipe, Path::new("/dev/zero")] {
            let error = read(endless).unwrap_err().to_string();
            assert!(error.contains("may never end"), "{error}");
        }
    }

    #[test]
    fn devices_and_open_files_stay_what_they_are() {
        let folder = Folder::new("devices");
        let device = folder.path("device");
        // If a link to a device were replaced, the device itself would stay.
        symlink("/dev/null", &device).unwrap();
        write(&device, |out| out.write_all(b"nothing")).unwrap();
        assert!(fs::metadata(&device).unwrap().file_type().is_char_device());
        let full = write("/dev/full", |out| out.write_all(b"nothing"));
        assert_eq!(full.unwrap_err().kind(), io::ErrorKind::StorageFull);
        // The open file of a shell's redirection, with its write position.
        let file = folder.path("open");
        let mut open = fs::File::create(&file).unwrap();
        open.write_all(b"begun, ").unwrap();
        let name = format!("/proc/self/fd/{}", std::os::fd::AsRawFd::as_raw_fd(&open));
        if Path::new(&name).exists() {
            write(name, |out| out.write_all(b"done")).unwrap();
            assert_eq!(read_text(&file), "begun, done");
        }
    }
}
