//! The texts that follow the options in the help of `ccd query`.

use ccd_tables::results::{ANSWERS, QuestionAnswers, Status, names};

/// The text at the end of `ccd query -h`.
pub(super) const AFTER_HELP: &str = "\
Examples:
  ccd query --a knot.obj --b knot.obj --motions motions.csv --out results.csv
  ccd query --a 'robot.glb#gripper' --b part.stl --unit mm --motions motions.csv
  ccd query --a gripper.stl --b shelf.stl --motions paths.csv --question closest-approach --clearance .01 --check
  ccd query --a gripper.stl --b shelf.stl --motions called-free.csv --check --tolerance 1e-6 --html missed.html
  printf 'a_pz,a_vz\\n3,-4\\n' | ccd query --a box:.5,.5,.5 --b box:9,9,1 --motions -

See `ccd query --help` for the columns of all tables and the exit codes.";

/// Returns the text at the end of `ccd query --help`.
pub(super) fn after_long_help() -> String {
    let questions: Vec<String> = ANSWERS.iter().map(question_text).collect();
    LONG_HELP.replace(QUESTIONS_PLACE, &questions.concat())
}

/// Describes a question with the statuses and columns of its answers.
fn question_text(answers: &QuestionAnswers) -> String {
    let list = |statuses: &[Status]| {
        let names: Vec<&str> = statuses.iter().map(|status| status.name()).collect();
        names.join(", ")
    };
    let QuestionAnswers {
        question,
        words,
        statuses,
        compared_statuses,
        more_columns,
    } = answers;
    let indent = " ".repeat(28);
    let mut text = format!(
        "  {:<26}{words}\n{indent}statuses {}",
        question.name(),
        list(statuses)
    );
    if !compared_statuses.is_empty() {
        text += &format!("; with --clearance {}", list(compared_statuses));
    }
    for column in names(more_columns) {
        text += &format!("; column {column}");
    }
    text + "\n"
}

/// The place of the questions in the help.
const QUESTIONS_PLACE: &str = "{questions}\n";

const LONG_HELP: &str = "\
Table of motions:
  Columns are identified by their names, in any order. Every column is optional.
  An empty cell is an error of its row. But a row with an end pose of a body leaves the velocities of
  that body empty, and a row with velocities leaves the end pose empty.
  Rows count from 0: in ids, in --rows and in messages. Lines of a file count from 1.
  In Parquet, columns hold numbers, text or booleans, and an absent value is an empty cell.
  id                        name of the row in the results [default: its number]
  a_px a_py a_pz            position of A at the start [default: 0]
  a_qw a_qx a_qy a_qz       orientation of A at the start, a quaternion [default: identity]
  a_vx a_vy a_vz            velocity of A's center, world frame, per unit of time [default: 0]
  a_wx a_wy a_wz            angular velocity of A, world frame, radians per unit of time [default: 0]
  a_end_px a_end_py a_end_pz a_end_qw a_end_qx a_end_qy a_end_qz
                            instead of velocities: pose of A at the end, reached by the shortest
                            rotation; a position or orientation without columns stays as at the start
  a_cx a_cy a_cz            center of rotation of A, in A's frame; it moves in a straight line
                            [default: A's origin]
  b_px, ...                 the same columns for B
  duration                  end of the motion, at least 0 [default: 1]

  Two rotations by half a turn lead to the same end pose. The command takes the one that is
  counterclockwise about the vector part (x, y, z) of end * start^-1, so the signs of the quaternions
  decide. Within 1e-15 of half a turn, rounding decides. Give velocities where the direction matters.

  Coordinates of meshes, positions and centers are from -1e12 to 1e12. --tolerance, --margin and the
  distance from B's position at the start to either center, at all times, are at most 1e12. Rotations
  are at most 1e6 radians. A row outside these ranges has status `error`.

Table of paths:
  A table with a column `t` has a row for each pose of a path, and a path for each id. Rows of one id
  follow each other. Each body moves as from a start to an end pose, from row to row.
  id                        name of the path in the results [default: all rows are one path]
  t                         time of the row, later than in the row before
  a_px ... a_qz, b_px, ...  poses of A and B at that time, as above
  a_cx a_cy a_cz, b_cx, ... center of rotation, as above, the same in all rows of a path
  a_wx a_wy a_wz, b_wx, ... angular velocity to the next row, for turns of more than half a turn; it may be
                            off by a quarter turn in all, and 0 is the shortest rotation; it needs a_qw ... [default: 0]
  The results have a row for each path, and --rows counts paths; with --question distance, a row for each
  row. Times are in the scale of column `t`.

Questions (--question):
{questions}
  Any row may also be unresolved. A contact interval has the status of its first contact.

Table of results:
  id                        as in the table of motions
  status    contact         within margin + tolerance at `time`, no contact before
            free            no contact during the whole duration: farther apart than the margin
            touching        within margin + tolerance at the start
            overlapping     intersecting at the start, or one body inside the other, which is a solid
            measured        the distance is between distance_lower and distance_upper
            kept            the distance is at least --clearance
            violated        the distance of the shapes inside the bodies is less than --clearance
            unverified      --clearance is between both bounds (a smaller --tolerance may decide), or a
                            limit was reached
            unresolved      a limit was reached; no contact before `time`, not known after
            error           the row is not a valid query; most cells are empty
  time                      certified: no contact before it; from 0 to the duration; of a distance,
                            when the bodies are nearest
  distance_lower, distance_upper
                            bounds of the distance at `time`; of closest-approach: distance_lower
                            holds at all times; empty when `free`, which proves the margin alone. The
                            distance_upper of a distance includes by how much bodies exceed their
                            shapes; the one of a contact does not
  normal_x ... normal_z     unit vector from A to B, world frame, at `time`
  witness_a_x ... witness_b_z
                            a pair of nearest points, world frame, at `time`
  feature_a, feature_b      v7, e3-7, f12: vertex, edge or face of the mesh, numbered from 0; p0: a
                            whole piece
  iterations, oracle_calls  pairs of nodes visited; calls of the distance backend
  micros                    time of this query in microseconds; for accurate times use --threads 1
  reason                    of `error`: what is wrong; of `unresolved`: the limit, one of budget,
                            deadline, stalled, oracle gave up, undecided. Where the budget is spent, a
                            larger --tolerance or --question is-free with a --margin often decides at once
  With --question contact-interval also:
  last_time                 certified: no contact after it, also where they touch or overlap at the start
  With --counters also:
  advancements              steps that advanced all pairs together; 0 for best-first
  oracle_steps, cycles      steps of the distance backend's search; returns to an earlier step
  fallbacks                 pairs that the distance backend gave up on and another one answered
  front                     largest number of pairs that waited at one time

Table of contacts (--contacts):
  For each row of status `contact` or `touching`, all pairs of features within margin + tolerance at
  that time, nearest first: a vertex and a face, or two edges that cross. Where there is no such
  pair, a vertex and an edge, or two vertices.
  id, time                  as in the table of results
  feature_a, feature_b, distance_lower, distance_upper, normal_x ... witness_b_z
                            as in the table of results, for the two features

Long runs:
  Rows are written in order, batch by batch, to files that end in .partial. They are renamed when all
  rows are there; existing files are kept until then. Repeat the same command with --resume to
  continue an interrupted run. A file that ends in .resume, next to --out, records the options and
  the progress. Only one run at a time writes a file; a second one refuses. The number of threads,
  --rows and interruptions change no byte of a row, except in column `micros` (see --no-micros) and
  with --deadline.

With --bound published, times are not certified: contacts may be late or missed.

Exit codes:
  0  every row has an answer, whatever it is: also `contact`, `violated` and `unresolved`
  1  the results or the contacts cannot be written
  2  bad input: a file or an option that cannot be used, an output that another run is writing, rows
     of status `error`, a row with more contacts than --budget allows, or with --check no row
  3  with --check: every row has an answer, and some are not `free` or, with --clearance, `kept`

Examples:
  ccd query --a knot.obj --b knot.obj --motions motions.csv --out results.csv
  ccd query --a part.stl --b box:1,1,.1 --motions - --tolerance 1e-6 < motions.csv
  ccd query --a part.stl --b part.stl --motions motions.csv --out results.csv --contacts contacts.csv
  ccd query --a part.stl --b part.stl --motions motions.csv --out results.csv \\
      --schedule fast --oracle vmarch --pieces patches --counters    # the method as published
  printf 'a_pz,a_vz\\n3,-4\\n' | ccd query --a box:.5,.5,.5 --b box:9,9,1 --motions -";
