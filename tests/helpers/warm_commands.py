"""A process of Qt's that begins with everything loaded."""

import warm_processes
from PySide6.QtCore import QProcess


class WarmProcess(QProcess):
    """As `QProcess`; cold where `warm_processes` has nothing to fork it from."""

    def start(self) -> None:
        words = [self.program(), *self.arguments()]
        environment = dict(pair.split("=", 1) for pair in self.processEnvironment().toStringList())
        if warm_processes.known(words, environment):
            program, *arguments = warm_processes.standing_in(words)
            self.setProgram(program)
            self.setArguments(arguments)
        super().start()
