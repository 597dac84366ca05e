"""Files that are no file, names taken, the same twice, options and words no command knows."""

from mistakes.kinds import made, wrong

PLACES = [
    wrong(
        "modes coarse.toml --count 2 --json coarse.toml", "coarse.toml: read by this command.*another name"
    ),
    wrong("damping hits.csv --json hits.csv", "hits.csv: read by this command"),
    wrong("card found.json --to json --out found.json", "found.json: read by this command"),
    wrong("compare found.json other.json --json coarse.toml", "coarse.toml: ending '.toml', expected .json"),
    wrong("modes coarse.toml --count 2 --json run.h5", "run.h5: ending '.h5', expected .json"),
    made(
        "a result over notes",
        "modes coarse.toml --json taken",
        "taken: another file stands there and is not written over, expected another name",
        "torque 25 N m",
    ),
    wrong(
        "card found.json --to nastran --out x.x", "x.x: ending '.x', expected .bdf or .nas or .dat or .txt"
    ),
    wrong("card found.json --to csv --out sweep.csv", "sweep.csv: a table stands there and is not written"),
    wrong("card found.json --to csv --out hits.csv", "hits.csv: a table stands there and is not written"),
    wrong(
        "card found.json --to abaqus --out coarse.toml", "coarse.toml: ending '.toml', expected .inp or .txt"
    ),
    wrong("demo --out .", "experiment.toml: an experiment stands there and is not written over"),
    made("--json is a folder", "modes coarse.toml --count 2 --json taken", "taken: is a folder"),
    made("a folder for the data", "identify taken --specimen coarse.toml", "taken: a folder, expected data"),
    made("a folder for the specimen", "modes taken", "taken: a folder, expected a specimen"),
    made("a folder for the sensors", "sensors taken", "taken: a folder, expected a list of sensors"),
    made("a folder for a new file", "new plate taken", "taken: there is a file already"),
    made("a card into a folder", "card found.json --to abaqus --out taken", "'taken' is a directory"),
    made(
        "a batch into a file", "batch sweep.csv --specimen coarse.toml --out taken", "'taken' is a file", "x"
    ),
    made("figures into a file", "plan coarse.toml --figures taken", "'taken' is a file", "x"),
    made("sessions into a file", "run experiment.toml --out taken", "'taken' is a file", "x"),
    wrong("modes coarse.toml --count 2 --json nowhere/x.json", "no such folder"),
    wrong("card found.json --to abaqus --out nowhere/x.inp", "no such folder"),
    wrong("plan coarse.toml --experiment nowhere/e.toml", "no such folder"),
    wrong("new plate coarse.toml", "coarse.toml: there is a file already"),
    wrong("new plate sheet.csv", "ending '.csv', expected .toml"),
    wrong("identify sweep.csv ./sweep.csv --specimen coarse.toml", "sweep.csv: named twice"),
    wrong("compare found.json found.json", "found.json: named twice"),
    wrong("damping hits.csv hits.csv", "hits.csv: named twice"),
    made("a folder for a batch", "batch taken", "taken: a folder, expected sessions, sweeps"),
    made("a folder for records", "damping taken", "taken: a folder, expected impact records"),
    wrong("damping coarse.toml", "coarse.toml: a specimen, expected impact records"),
    wrong(
        "identify sweep.csv --specimen coarse.toml --hammer coarse.toml",
        "coarse.toml: a specimen, expected the JSON of 'viscorig damping'",
    ),
    made("a folder to import", "import taken", "taken: a folder, expected a file"),
    made("a folder for an experiment", "check taken", "taken: a folder, expected an experiment"),
    made("a folder for a rig", "doctor taken", "taken: a folder, expected a rig"),
    made("a batch of nothing", "batch taken", "taken: the file is empty", ""),
    made("a batch of words", "batch taken", "begins with a column 'data'", "x"),
    wrong("batch coarse.toml", "coarse.toml: a specimen, expected sessions, sweeps"),
    wrong("batch found.json", r"found.json: a law \('viscorig identify'\), expected sessions, sweeps"),
    wrong("identify found.json --specimen coarse.toml", "found.json: a law .*, expected data: a sweep"),
    wrong("identify hits.csv --specimen coarse.toml", "an impact record, expected a sweep: 'viscorig dam"),
    wrong("check sweep.csv", "sweep.csv: a table, expected an experiment"),
    wrong("sensors sweep.csv", "sweep.csv: a table, expected a list of sensors"),
    wrong("sensors coarse.toml", "coarse.toml: a specimen, expected a list of sensors"),
    made(
        "a batch by semicolons", "batch taken", "commas between its columns", "data;specimen\na.csv;b.toml\n"
    ),
    made("sensors in an empty file", "sensors taken", "empty", ""),
    made("a law in an empty file", "compare found.json taken", "empty", ""),
    made("no session", "export taken --to csv", "not a session", "x"),
    wrong("plan beam.toml", "a beam, expected a plate"),
    wrong("plan coarse.toml --level 9.81m/s", "0.5g or 4.9m/s2"),
    wrong("plan coarse.toml --band 10,300", "LOW:HIGH"),
    wrong("doctor sweep.csv", "sweep.csv: a table, expected a rig"),
    wrong("compare found.json", "one file, expected two"),
    wrong("modes grö\u00dfe².toml", "grö\u00dfe².toml: No such file"),
    wrong("identfy sweep.csv", "is it 'identify'"),
    wrong("sweep.csv", "a file, expected a command before it"),
    made(
        "a report for a word processor",
        "report taken --out report.docx",
        "ending '.docx', expected .html",
        "x",
    ),
    made(
        "sheets with a page's ending", "report taken --pdf report.html", "ending '.html', expected .pdf", "x"
    ),
    wrong("predict coarse.toml --frequencies 14:310", "A:B:STEP"),
    wrong("predict coarse.toml --frequencies 0,20", "above 0 Hz"),
    wrong("modes coarse.toml --count 0", "range"),
]
