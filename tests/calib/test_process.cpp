// SPDX-License-Identifier: AGPL-3.0-or-later

#include "program/process.h"
#include "program/temporary_folder.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>

namespace
{

using namespace tiltcal;

ProcessSetup Shell(const std::string& script)
{
	return { { "sh", "-c", script } };
}

std::string Contents(const std::string& file)
{
	std::ifstream in(file, std::ios::binary);
	return { std::istreambuf_iterator<char>(in), {} };
}

/// The process whose number a script left in `file` is gone, or soon will be.
bool IsGone(const std::string& file)
{
	const pid_t process = std::stoi(Contents(file));
	// One that nobody has waited for is still there, as a zombie.
	for (int i = 0; i < 100; ++i)
	{
		const std::string state = Contents("/proc/" + std::to_string(process) + "/stat");
		if (kill(process, 0) != 0 || state.find(") Z ") != std::string::npos)
			return true;
		std::this_thread::sleep_for(std::chrono::milliseconds(20));
	}
	return false;
}

TEST(Process, ItsWordsReachItAsTheyAre)
{
	EXPECT_EQ(RunProcess({ { "printf", "%s|", "a b", "$HOME", "'*'", "" } }).said, "a b|$HOME|'*'||");
}

TEST(Process, ItsEndIsTold)
{
	EXPECT_EQ(RunProcess(Shell("exit 0")).exit_code, 0);
	EXPECT_EQ(RunProcess(Shell("exit 7")).exit_code, 7);
	EXPECT_EQ(RunProcess(Shell("kill -s SEGV $$")).exit_code, 128 + SIGSEGV);
	EXPECT_EQ(RunProcess({ { "no-such-program-anywhere" } }).exit_code, 127);
	ProcessSetup nowhere = Shell("exit 0");
	nowhere.folder = "/no/such/folder";
	EXPECT_EQ(RunProcess(nowhere).exit_code, 126);
}

TEST(Process, InputOutputFolderAndEnvironment)
{
	const TemporaryFolder folder("tiltcal-process");
	ProcessSetup setup = Shell("cat; echo \"$PROCESS_TEST $HOME\" >&2; pwd");
	setup.folder = folder.Path();
	setup.environment = { "PROCESS_TEST=one two", "HOME=elsewhere" };
	// More than a pipe holds.
	setup.input = std::string(300000, 'x') + "\n";
	const std::string expected = setup.input + "one two elsewhere\n" + std::filesystem::canonical(folder.Path()).string() + "\n";
	EXPECT_EQ(RunProcess(setup).said, expected);
	setup.log = folder.File("log");
	EXPECT_EQ(RunProcess(setup).said, "");
	EXPECT_EQ(Contents(setup.log), expected);
	// Without input there is none to wait for.
	EXPECT_EQ(RunProcess({ { "cat" } }).said, "");
}

TEST(Process, TimeIsMeasured)
{
	const ProcessResult slept = RunProcess({ { "sleep", "0.2" } });
	EXPECT_GE(slept.wall, 0.2);
	EXPECT_LT(slept.cpu, 0.1);
	// A grandchild's work counts.
	const ProcessResult worked = RunProcess(Shell("sh -c 'i=0; while [ $i -lt 100000 ]; do i=$((i + 1)); done'; true"));
	EXPECT_GT(worked.cpu, 0.01);
	EXPECT_GT(worked.most_memory, 0.1);
}

TEST(Process, TheTimeoutKillsItsWholeGroup)
{
	const TemporaryFolder folder("tiltcal-process");
	ProcessSetup setup = Shell("trap '' TERM; sleep 60 & echo $! > grandchild; wait");
	setup.folder = folder.Path();
	setup.timeout = 0.5;
	const ProcessResult result = RunProcess(setup);
	EXPECT_TRUE(result.late);
	EXPECT_EQ(result.exit_code, 128 + SIGKILL);
	EXPECT_LT(result.wall, 20);
	EXPECT_TRUE(IsGone(folder.File("grandchild")));
	EXPECT_FALSE(RunProcess(Shell("kill -s KILL $$")).late);
}

TEST(Process, TheWatchEndsItAndWhatItStarted)
{
	const TemporaryFolder folder("tiltcal-process");
	ProcessSetup setup = Shell("sleep 60 & echo $! > grandchild; wait");
	setup.folder = folder.Path();
	double last = 0;
	const ProcessResult result = RunProcess(setup, [&](double seconds) { last = seconds; return seconds < 0.3; });
	EXPECT_TRUE(result.stopped);
	EXPECT_GE(last, 0.3);
	EXPECT_TRUE(IsGone(folder.File("grandchild")));
}

TEST(Process, ManyRunBesideEachOther)
{
	std::vector<Process> running;
	for (int i = 0; i < 5; ++i)
		running.emplace_back(Shell("sleep 0.3; exit " + std::to_string(i)));
	for (int i = 0; i < 5; ++i)
		EXPECT_EQ(running[size_t(i)].Wait().exit_code, i);
}

TEST(Process, WhatIsLeftAloneIsKilled)
{
	const TemporaryFolder folder("tiltcal-process");
	{
		ProcessSetup setup = Shell("sleep 60 & echo $! > grandchild; echo $$ > child; wait");
		setup.folder = folder.Path();
		const Process process(setup);
		while (Contents(folder.File("child")).empty())
			std::this_thread::sleep_for(std::chrono::milliseconds(5));
	}
	EXPECT_TRUE(IsGone(folder.File("child")));
	EXPECT_TRUE(IsGone(folder.File("grandchild")));
}

TEST(ProcessDeathTest, AnInterruptEndsItsGroupAndIsThrown)
{
	const TemporaryFolder folder("tiltcal-process");
	const auto start = std::chrono::steady_clock::now();
	// In a child of the test's own: from CatchInterrupts there is no way back.
	EXPECT_EXIT(
		{
			CatchInterrupts();
			ProcessSetup setup = Shell("sleep 60 & echo $! > grandchild; kill -s TERM $PPID; wait");
			setup.folder = folder.Path();
			try
			{
				RunProcess(setup);
			}
			catch (const Interrupted& e)
			{
				_exit(e.signal == SIGTERM ? 42 : 1);
			}
			_exit(2);
		},
		testing::ExitedWithCode(42), "");
	// Not by itself: GoogleTest waits for whoever holds its pipe.
	EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(30));
	EXPECT_TRUE(IsGone(folder.File("grandchild")));
}

}
