"""A cluster on loopback: munged, slurmctld and a slurmd for each node, in a temporary folder, with ports of its own.

Nothing needs root, and nothing outlives the process that starts it: daemons stay in the foreground and end with it, and
what they leave behind becomes a child of that process (PR_SET_CHILD_SUBREAPER). If it is killed, a guard ends the steps of jobs.
"""
import ctypes
import os
import pathlib
import pwd
import shutil
import signal
import socket
import subprocess
import sys
import time

PR_SET_PDEATHSIG, PR_SET_CHILD_SUBREAPER = 1, 36
PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "squeue", "scontrol", "scancel")


def missing_programs():
    return [name for name in PROGRAMS if program(name) is None]


def program(name):
    return shutil.which(name, path=os.environ.get("PATH", "") + ":/usr/sbin:/sbin")


def end_with_parent():
    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)


def adopt_orphans():
    ctypes.CDLL(None).prctl(PR_SET_CHILD_SUBREAPER, 1)


def read(path):
    try:
        return path.read_bytes()
    except OSError:
        return b""


def parents():
    """Of all processes, by number."""
    found = {}
    for folder in pathlib.Path("/proc").iterdir():
        if folder.name.isdigit():
            fields = read(folder / "stat").rpartition(b")")[2].split()
            if len(fields) > 1 and fields[0] != b"Z":
                found[int(folder.name)] = int(fields[1])
    return found


def descendants(process):
    of, found = parents(), {process}
    while True:
        more = {child for child, parent in of.items() if parent in found} - found
        if not more:
            return found - {process}
        found |= more


def reap(known):
    """Ended processes that were adopted; those of `known` are waited for elsewhere."""
    own = os.getpid()
    for folder in pathlib.Path("/proc").iterdir():
        if folder.name.isdigit() and int(folder.name) not in known:
            fields = read(folder / "stat").rpartition(b")")[2].split()
            if fields[:2] == [b"Z", str(own).encode()]:
                os.waitpid(int(folder.name), os.WNOHANG)


def kill(processes):
    for process in processes:
        try:
            os.kill(process, signal.SIGKILL)
        except ProcessLookupError:
            pass


def kill_descendants():
    """Until there are none: a process may start others meanwhile."""
    while True:
        kill(descendants(os.getpid()))
        try:
            while os.waitpid(-1, os.WNOHANG)[0] > 0:
                pass
        except ChildProcessError:
            return
        time.sleep(0.05)


def has_configuration(process, folder):
    """Whether it belongs to the cluster in the folder."""
    return f"SLURM_CONF={folder}/slurm.conf".encode() in read(pathlib.Path(f"/proc/{process}/environ")).split(b"\0")


def guard(folder):
    """Waits for the end of the process that has started it, which holds its standard input open."""
    sys.stdin.read()
    while left := [process for process in parents() if has_configuration(process, folder)]:
        kill(left)
        time.sleep(0.1)


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


class Cluster:
    """Nodes n1, n2, ... Daemons are killed and started one by one, by their names: a node's is its own."""

    def __init__(self, folder, nodes=2, cpus=1, megabytes=4000):
        self.folder = pathlib.Path(folder)
        self.nodes = [f"n{i + 1}" for i in range(nodes)]
        self.cpus, self.megabytes = cpus, megabytes
        self.daemons = {}
        self.environment = {**os.environ, "SLURM_CONF": str(self.folder / "slurm.conf")}

    def start(self):
        adopt_orphans()
        self.guard = subprocess.Popen([sys.executable, __file__, self.folder], stdin=subprocess.PIPE)
        for name in ("state", "log"):
            (self.folder / name).mkdir(parents=True)
        key = self.folder / "munge.key"
        key.write_bytes(os.urandom(1024))
        key.chmod(0o400)
        self.run_daemon("munged", "--foreground", "--force", f"--key-file={key}", f"--socket={self.folder}/munge.sock",
                        f"--pid-file={self.folder}/munged.pid", f"--log-file={self.folder}/log/munged.log",
                        f"--seed-file={self.folder}/munge.seed")
        # Another program may take a port between its choice and its use.
        for _ in range(5):
            self.write_configuration()
            self.start_controller()
            for node in self.nodes:
                self.start_node(node)
            if self.wait_until_idle(60):
                return
            for name in [*self.nodes, "slurmctld"]:
                self.kill_daemon(name)
        raise RuntimeError("the cluster does not start:\n" + self.logs())

    def write_configuration(self):
        host, user = socket.gethostname().split(".")[0], pwd.getpwuid(os.geteuid()).pw_name
        controller, *ports = free_ports(1 + len(self.nodes))
        folder = self.folder
        text = f"""ClusterName=loopback
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.sock,cred_expire=5
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool-%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd-%n.pid
SlurmctldLogFile={folder}/log/slurmctld.log
SlurmdLogFile={folder}/log/%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
JobCompType=jobcomp/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU_Memory
SlurmdParameters=config_overrides
SchedulerParameters=batch_sched_delay=0,sched_interval=2
ReturnToService=2
MessageTimeout=5
SlurmdTimeout=8
SlurmctldTimeout=8
BatchStartTimeout=20
KillWait=2
MinJobAge=4
"""
        for node, port in zip(self.nodes, ports):
            text += (f"NodeName={node} NodeHostname={host} NodeAddr=127.0.0.1 Port={port} CPUs={self.cpus} "
                     f"RealMemory={self.megabytes}\n")
        (folder / "slurm.conf").write_text(text + "PartitionName=main Nodes=ALL Default=YES MaxTime=60 State=UP\n")

    def run_daemon(self, name, *arguments, command=None):
        with open(self.folder / "log" / f"{name}.out", "ab") as output:
            self.daemons[name] = subprocess.Popen([program(command or name), *arguments], env=self.environment, stdout=output,
                                                  stderr=output, stdin=subprocess.DEVNULL, preexec_fn=end_with_parent)

    def start_controller(self):
        self.run_daemon("slurmctld", "-D")

    def start_node(self, node):
        self.run_daemon(node, "-D", "-N", node, command="slurmd")

    def kill_daemon(self, name):
        daemon = self.daemons.pop(name, None)
        if daemon:
            daemon.kill()
            daemon.wait()

    def processes_of_node(self, node):
        """What its jobs have started, and the steps that watch them."""
        of = parents()
        name = f"SLURMD_NODENAME={node}".encode()
        jobs = {process for process in of if has_configuration(process, self.folder) and
                name in read(pathlib.Path(f"/proc/{process}/environ")).split(b"\0")}
        steps = {of[process] for process in jobs if b"slurmstepd" in read(pathlib.Path(f"/proc/{of[process]}/comm"))}
        return jobs | steps

    def kill_node(self, node):
        """As if it lost its power."""
        self.kill_daemon(node)
        kill(self.processes_of_node(node))

    def call(self, *command):
        """Its output; empty where the controller does not answer."""
        result = subprocess.run(command, env=self.environment, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                                text=True, check=False)
        return result.stdout if result.returncode == 0 else ""

    def running_jobs(self):
        return sorted(self.call("squeue", "--noheader", "--states=RUNNING", "--format=%i").split(), key=int)

    def wait_until_idle(self, seconds):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            states = self.call("sinfo", "--noheader", "--Node", "--format=%T").split()
            if len(states) == len(self.nodes) and set(states) == {"idle"}:
                return True
            time.sleep(0.5)
        return False

    def repair_nodes(self):
        """A node that the controller has set aside, because a step did not end, takes jobs again."""
        for line in self.call("sinfo", "--noheader", "--Node", "--format=%N %T").splitlines():
            node, state = line.split()
            if node in self.daemons and state.rstrip("*") in ("drained", "draining", "down"):
                self.call("scontrol", "update", f"nodename={node}", "state=resume")

    def logs(self):
        return "\n".join(f"== {log.name}\n" + log.read_text(errors="replace")[-3000:]
                         for log in sorted((self.folder / "log").iterdir()))


if __name__ == "__main__":
    guard(sys.argv[1])
