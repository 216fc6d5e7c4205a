use super::error::StoreFault;
use super::frame;
use crate::{Format, PatchOrder, PieceChoice, StoredBodyContent, TriangleMesh, prepare};
use proptest::prelude::*;
use rstest::rstest;
use std::sync::LazyLock;

const TETRAHEDRON_OBJ: &str =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

/// The OBJ text of a tetrahedron with a dent, with a duplicate face and an unused vertex that the report mentions.
const DENTED_OBJ: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv .2 .2 .2\nv 9 9 9\n\
     f 1 3 2\nf 1 2 4\nf 3 1 4\nf 2 3 5\nf 3 4 5\nf 4 2 5\nf 4 2 5\n";

fn model(file: &str, choice: PieceChoice) -> StoredBodyContent {
    let mesh = TriangleMesh::from_reader(Format::Obj, file.as_bytes()).unwrap();
    prepare(&mesh, choice).unwrap()
}

fn stored_bytes(model: &StoredBodyContent) -> Vec<u8> {
    let mut bytes = Vec::new();
    model.write(&mut bytes).unwrap();
    bytes
}

fn fault(bytes: &[u8]) -> StoreFault {
    match StoredBodyContent::read(bytes) {
        Ok(_) => panic!("read"),
        Err(error) => error.fault,
    }
}

/// Stored bodies of every kind of pieces, with and without a hull tree. They are small enough to change every byte.
static STORED_BODIES: LazyLock<Vec<Vec<u8>>> = LazyLock::new(|| {
    let patches = model(DENTED_OBJ, PieceChoice::Patches(PatchOrder::Cresting));
    let models = [
        model(DENTED_OBJ, PieceChoice::Triangles),
        patches.clone(),
        patches.with_hull_tree().unwrap(),
        model(TETRAHEDRON_OBJ, PieceChoice::Hull),
        model(TETRAHEDRON_OBJ, PieceChoice::OuterHull),
    ];
    models.iter().map(stored_bytes).collect()
});

#[rstest]
#[case(DENTED_OBJ, PieceChoice::Triangles)]
#[case(DENTED_OBJ, PieceChoice::Patches(PatchOrder::Cresting))]
#[case(DENTED_OBJ, PieceChoice::OuterHull)]
#[case(TETRAHEDRON_OBJ, PieceChoice::Hull)]
fn stored_models_are_read_unchanged(#[case] file: &str, #[case] choice: PieceChoice) {
    let model = model(file, choice);
    let bytes = stored_bytes(&model);
    let again = StoredBodyContent::read(&bytes[..]).unwrap();
    assert_eq!(stored_bytes(&again), bytes);
    assert_eq!(again.report, model.report);
    assert_eq!(again.pieces.points(), model.pieces.points());
    assert_eq!(again.hierarchy.nodes(), model.hierarchy.nodes());
    let bodies = (again.body().unwrap(), model.body().unwrap());
    assert_eq!(bodies.0.memory_usage(), bodies.1.memory_usage());
    assert_eq!(bodies.0.excess(), model.report.excess);
    let is_exact = choice != PieceChoice::OuterHull;
    assert_eq!(bodies.0.excess() == 0.0, is_exact);
    let taken_over = StoredBodyContent::from_body(&bodies.0).unwrap();
    assert_eq!(taken_over.report.excess, bodies.0.excess());
}

#[test]
fn a_hull_tree_is_stored_with_its_body() {
    let model = model(DENTED_OBJ, PieceChoice::Patches(PatchOrder::Cresting))
        .with_hull_tree()
        .unwrap();
    let again = StoredBodyContent::read(&stored_bytes(&model)[..]).unwrap();
    let nodes = |model: &StoredBodyContent| model.hull_tree.as_ref().unwrap().to_nodes();
    assert!(nodes(&model).len() >= 3);
    assert_eq!(nodes(&again), nodes(&model));
    assert!(again.body().unwrap().hull_tree().is_some());
}

#[test]
fn files_are_named_in_errors() {
    let folder = std::env::temp_dir().join(format!("ccd-store-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join("part.ccd");
    let model = model(DENTED_OBJ, PieceChoice::Triangles);
    model.save(&path).unwrap();
    assert_eq!(StoredBodyContent::load(&path).unwrap().report, model.report);
    std::fs::write(&path, &stored_bytes(&model)[..40]).unwrap();
    let message = StoredBodyContent::load(&path).unwrap_err().to_string();
    assert!(message.contains("part.ccd: is cut short"), "{message}");
    assert!(message.contains("ccd decompose MESH --out"), "{message}");
    let nowhere = folder.join("no/such/folder.ccd");
    let message = [
        StoredBodyContent::load(&nowhere).unwrap_err().to_string(),
        model.save(&nowhere).unwrap_err().to_string(),
    ];
    assert!(
        message[0].contains("folder.ccd: cannot be read"),
        "{}",
        message[0]
    );
    assert!(
        message[1].contains("folder.ccd: cannot be written"),
        "{}",
        message[1]
    );
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn a_foreign_file_is_reported() {
    let files: [&[u8]; 4] = [
        b"",
        b"# an obj\nv 0 0 0\n",
        b"\x89PNG\r\n\x1a\n.........",
        b"\x89ccd\n",
    ];
    for bytes in files {
        assert!(
            matches!(fault(bytes), StoreFault::NotStoredBody),
            "{bytes:?}"
        );
    }
}

#[test]
fn another_version_is_reported_before_damage() {
    let mut bytes = stored_bytes(&model(DENTED_OBJ, PieceChoice::Triangles));
    bytes[8] = 0xff;
    assert!(matches!(
        fault(&bytes),
        StoreFault::UnsupportedVersion { version: 0xff }
    ));
    let message = fault(&bytes).to_string();
    assert!(
        message.contains("version 255") && message.contains("version 3 is what is read"),
        "{message}"
    );
}

#[test]
fn a_pointer_of_git_lfs_is_recognised() {
    let fault = fault(b"version https://git-lfs.github.com/spec/v1\noid sha256:0\n");
    assert!(matches!(fault, StoreFault::LfsPointer), "{fault}");
    assert!(fault.to_string().contains("git lfs pull"), "{fault}");
}

#[test]
fn a_file_cut_anywhere_is_an_error() {
    for bytes in STORED_BODIES.iter() {
        for end in 0..bytes.len() {
            let fault = fault(&bytes[..end]);
            let cut = matches!(fault, StoreFault::Truncated);
            assert!(
                cut || end < 8 && matches!(fault, StoreFault::NotStoredBody),
                "{end}: {fault}"
            );
        }
    }
}

#[test]
fn a_file_with_more_behind_it_is_damaged() {
    let mut bytes = stored_bytes(&model(DENTED_OBJ, PieceChoice::Triangles));
    bytes.push(0);
    assert!(matches!(fault(&bytes), StoreFault::ChecksumMismatch));
}

#[test]
fn every_bit_counts() {
    let bytes = stored_bytes(&model(TETRAHEDRON_OBJ, PieceChoice::Triangles));
    for at in 0..bytes.len() {
        for bit in 0..8 {
            let mut changed = bytes.clone();
            changed[at] ^= 1 << bit;
            fault(&changed);
        }
    }
}

#[test]
fn a_length_that_no_memory_holds_is_a_cut_file() {
    let mut bytes = stored_bytes(&model(DENTED_OBJ, PieceChoice::Triangles));
    bytes[12..20].copy_from_slice(&u64::MAX.to_le_bytes());
    assert!(matches!(fault(&bytes), StoreFault::Truncated));
}

#[test]
fn parts_that_do_not_belong_together_are_reported() {
    let (mut small, large) = (
        model(TETRAHEDRON_OBJ, PieceChoice::Triangles),
        model(DENTED_OBJ, PieceChoice::Triangles),
    );
    small.hierarchy = large.hierarchy;
    assert!(matches!(
        fault(&stored_bytes(&small)),
        StoreFault::InvalidContent { .. }
    ));
    let mut miscounted = model(DENTED_OBJ, PieceChoice::Triangles);
    miscounted.report.pieces += 1;
    assert!(matches!(
        fault(&stored_bytes(&miscounted)),
        StoreFault::InvalidContent { .. }
    ));
}

/// Checks that arbitrary bytes either give an error or load as a valid body.
fn check(bytes: &[u8]) {
    if let Ok(model) = StoredBodyContent::read(bytes) {
        let body = model.body().unwrap();
        assert_eq!(body.pieces().len(), model.report.pieces);
        let _ = model.report.to_string();
    }
}

/// Wraps a changed payload in a header and a matching checksum.
fn wrap_in_frame(payload: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    frame::write(&mut bytes, payload).unwrap();
    bytes
}

#[test]
fn a_payload_cut_anywhere_is_an_error() {
    for bytes in STORED_BODIES.iter() {
        let payload = frame::read(&bytes[..]).unwrap();
        for end in 0..payload.len() {
            let fault = fault(&wrap_in_frame(&payload[..end]));
            assert!(
                matches!(fault, StoreFault::InvalidContent { .. }),
                "{end}: {fault}"
            );
        }
    }
}

#[test]
fn no_single_change_of_a_payload_panics() {
    for bytes in STORED_BODIES.iter() {
        let payload = frame::read(&bytes[..]).unwrap();
        for at in 0..payload.len() {
            for value in [0, 1, 2, 0x7f, 0x80, 0xff] {
                let mut changed = payload.clone();
                changed[at] = value;
                check(&wrap_in_frame(&changed));
            }
        }
    }
}

proptest! {
    #[test]
    fn no_bytes_panic(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        check(&bytes);
        check(&wrap_in_frame(&bytes));
    }

    #[test]
    fn no_changes_of_a_payload_panic(
        file in any::<prop::sample::Index>(),
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
        cut in any::<prop::sample::Index>(),
    ) {
        let bytes = &STORED_BODIES[file.index(STORED_BODIES.len())];
        let mut payload = frame::read(&bytes[..]).unwrap();
        for (at, byte) in changes {
            let at = at.index(payload.len());
            payload[at] = byte;
        }
        check(&wrap_in_frame(&payload));
        check(&wrap_in_frame(&payload[cut.index(payload.len())..]));
    }
}

/// Creates an empty folder for the files of the test `name`.
fn create_empty_folder(name: &str) -> std::path::PathBuf {
    let folder = std::env::temp_dir().join(format!("ccd-{name}-{}", std::process::id()));
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

#[test]
fn threads_save_side_by_side() {
    let folder = create_empty_folder("side-by-side");
    let models = [TETRAHEDRON_OBJ, DENTED_OBJ].map(|mesh| model(mesh, PieceChoice::Triangles));
    std::thread::scope(|scope| {
        for thread in 0..4 {
            let (model, folder) = (&models[thread % 2], &folder);
            scope.spawn(move || {
                for _ in 0..50 {
                    // Names that differ only in their endings, and a name that all share.
                    let own = folder.join(format!("body.v{thread}"));
                    model.save(&own).unwrap();
                    assert_eq!(
                        stored_bytes(&StoredBodyContent::load(&own).unwrap()),
                        stored_bytes(model)
                    );
                    let shared = folder.join("shared.ccd");
                    model.save(&shared).unwrap();
                    assert!(StoredBodyContent::load(&shared).is_ok());
                }
            });
        }
    });
    let left = std::fs::read_dir(&folder).unwrap().count();
    assert_eq!(left, 5, "no parts are left");
    std::fs::remove_dir_all(&folder).unwrap();
}

#[cfg(unix)]
#[test]
fn links_are_followed_and_devices_stay_what_they_are() {
    use std::os::unix::fs::{FileTypeExt, symlink};
    let folder = create_empty_folder("links");
    let body = model(TETRAHEDRON_OBJ, PieceChoice::Hull);
    let (target, link) = (folder.join("target.ccd"), folder.join("link.ccd"));
    std::fs::write(&target, "old").unwrap();
    symlink(&target, &link).unwrap();
    body.save(&link).unwrap();
    assert!(std::fs::symlink_metadata(&link).unwrap().is_symlink());
    assert_eq!(
        stored_bytes(&StoredBodyContent::load(&target).unwrap()),
        stored_bytes(&body)
    );

    // A link to a device: if it were replaced, the device itself would stay.
    let device = folder.join("device.ccd");
    symlink("/dev/null", &device).unwrap();
    body.save(&device).unwrap();
    let there = std::fs::metadata(&device).unwrap();
    assert!(there.file_type().is_char_device());
    assert!(std::fs::symlink_metadata(&device).unwrap().is_symlink());
    assert!(body.save(&folder).is_err(), "a folder");
    std::fs::remove_dir_all(&folder).unwrap();
}

/// Tests that the remarks of a mesh are stored and read back, and that older files load without remarks.
#[test]
fn remarks_are_stored() {
    let plain = model(TETRAHEDRON_OBJ, PieceChoice::Triangles);
    let text = [TETRAHEDRON_OBJ, "l 1 2\nvc 1\n"].concat();
    let remarked = model(&text, PieceChoice::Triangles);
    let again = StoredBodyContent::read(&stored_bytes(&remarked)[..]).unwrap();
    assert_eq!(again.report, remarked.report);
    assert_eq!(again.report.repairs.remarks.iter().count(), 2);
    assert!(
        again
            .report
            .to_string()
            .contains("lines passed over: 1 (line 9)"),
        "{}",
        again.report
    );
    assert!(stored_bytes(&remarked).len() > stored_bytes(&plain).len());
}
